// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/journey/locate.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/assimilated_oscillator.hpp"
#include "trajectories/smoother/spectral_lines.hpp"

namespace lacuna {
namespace {

TEST(Locate, FindsTheRegionOfAStop) {
  const Assimilation fit = support::assimilated(support::hidden_record(
      [](double, double q, double) { return q > 0.4 ? -1.0 : 0.0; }, 0.005));
  const auto found = locate(fit, RunContext{});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].equation, 1);
  EXPECT_GT(found[0].sigma, 5.0);
  EXPECT_NEAR(found[0].fraction, 1.0, 1e-9);
  EXPECT_EQ(found[0].where[0].variable, "q");
}

TEST(Locate, FindsTheFrequencyOfAForcing) {
  const Assimilation fit = support::assimilated(support::hidden_record(
      [](double t, double, double) {
        return 0.2 * std::sin(2.0 * std::numbers::pi * 1.3 * t + 0.7);
      },
      0.005));
  const auto lines = spectral_lines(fit, 1);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].frequency, 1.3, 0.02);
  EXPECT_NEAR(std::remainder(lines[0].phase - 0.7, 2.0 * std::numbers::pi), 0.0, 0.6);
  const auto found = locate(fit, RunContext{});
  ASSERT_TRUE(found[0].where[0].frequency.has_value());
  EXPECT_NEAR(*found[0].where[0].frequency, 1.3, 0.02);
}

}  // namespace
}  // namespace lacuna
