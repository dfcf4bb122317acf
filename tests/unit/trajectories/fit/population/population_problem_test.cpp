// SPDX-License-Identifier: MIT
#include "trajectories/fit/population/population_problem.hpp"

#include <gtest/gtest.h>

#include "support/populations.hpp"

namespace lacuna {
namespace {

TEST(VaryingParameter, DerivativesAreThoseOfItsValue) {
  constexpr double kStep = 1e-6;
  for (const bool by_factor : {false, true}) {
    const VaryingParameter one{0, by_factor, 0.3};
    const auto value = [&](double typical, double z) { return one.value(typical, 0.3, z); };
    EXPECT_NEAR(one.by_deviation(2.0, 0.3, 0.7),
                (value(2.0, 0.7 + kStep) - value(2.0, 0.7 - kStep)) / (2.0 * kStep), 1e-8);
    EXPECT_NEAR(one.by_typical(0.3, 0.7),
                (value(2.0 + kStep, 0.7) - value(2.0 - kStep, 0.7)) / (2.0 * kStep), 1e-8);
    EXPECT_NEAR(value(2.0, one.deviation_at(1.5, 2.0, 0.3)), 1.5, 1e-12) << by_factor;
  }
}

}  // namespace
}  // namespace lacuna
