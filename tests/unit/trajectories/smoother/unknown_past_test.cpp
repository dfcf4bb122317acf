// SPDX-License-Identifier: MIT
#include "trajectories/smoother/unknown_past.hpp"

#include <gtest/gtest.h>

#include "lacuna/model/files/ode_text.hpp"
#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

constexpr const char* kLate =
    "input F\ndq/dt = v\ndv/dt = -4*q - 0.2*v + 3*delay(F, 1.5) + delay(q, 0.5)\n";

TEST(UnknownPast, IsAsLongAsTheLongestDelayOfAnEquation) {
  const Vector longest = longest_delays(parse_ode(kLate, "late"));
  EXPECT_EQ(longest[0], 0.0);
  EXPECT_EQ(longest[1], 1.5);
}

TEST(UnknownPast, MovesTheStateAsAValueAnywhereInTheRangeDoes) {
  const OdeModel late = parse_ode(kLate, "late");
  const Dataset data = support::oscillator_record();
  const LinearisedRecord record =
      grid_of(data.inputs, data.trajectories[0], data.trajectories[0].states);
  const Matrix density = unknown_past(late, record);
  ASSERT_EQ(density.rows(), 2);
  ASSERT_EQ(density.cols(), 1000);
  EXPECT_TRUE(density.row(0).isZero(0.0)) << "dq/dt = v has no past";
  const double of_force = 1.5 * 9.0 / 12.0, of_state = 0.5 * 4.0 / 12.0;
  EXPECT_NEAR(density(1, 0), of_force + of_state, 1e-3);
  EXPECT_NEAR(density(1, 60), of_force, 1e-3) << "q is known by 0.6 s";
  EXPECT_EQ(density(1, 151), 0.0) << "F is known by 1.5 s";
  EXPECT_EQ(unknown_past(support::oscillator(), record).size(), 0) << "no delays";
}

}  // namespace
}  // namespace lacuna
