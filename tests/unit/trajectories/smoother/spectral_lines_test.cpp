// SPDX-License-Identifier: MIT
#include "trajectories/smoother/spectral_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

TEST(ModulationLines, FindWhereACoefficientSwings) {
  constexpr double kFrequency = 0.35, kPhase = 0.7;
  const auto swinging = [](double t, double q, double) {
    return q * std::sin(2.0 * std::numbers::pi * kFrequency * t + kPhase);
  };
  const Assimilation fit = support::assimilated(support::hidden_record(swinging, 1e-3));
  const std::vector<ModulationLine> lines = modulation_lines(fit, 3);
  ASSERT_EQ(lines.size(), 3u);  // one for each term of dv/dt
  const auto found = std::find_if(lines.begin(), lines.end(), [](const ModulationLine& one) {
    return one.term.to_string() == "q";
  });
  ASSERT_NE(found, lines.end());
  EXPECT_EQ(found->line.equation, 1);
  const double resolution = 1.0 / (fit.records.front().time.tail<1>()[0]);
  EXPECT_NEAR(found->line.frequency, kFrequency, 0.5 * resolution);
  EXPECT_NEAR(std::remainder(found->line.phase - kPhase, 2.0 * std::numbers::pi), 0.0, 1.2);
}

}  // namespace
}  // namespace lacuna
