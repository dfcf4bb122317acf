// SPDX-License-Identifier: MIT
#include "lacuna/estimation/disturbance_test.hpp"

#include <gtest/gtest.h>

#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

TEST(Structure, IsSignificantWhereATermIsMissing) {
  const Assimilation fit =
      support::assimilated(support::hidden_record(support::dry_friction, 0.01));
  const auto structure = test_disturbances(fit, RunContext{});
  ASSERT_EQ(structure.size(), 1u) << "the identity is exact";
  EXPECT_EQ(structure[0].equation, 1);
  EXPECT_GT(structure[0].sigma, 8.0);
  EXPECT_GT(structure[0].relative, 0.01);
}

TEST(Structure, IsNotSignificantInACompleteModel) {
  const Assimilation fit = support::assimilated(support::hidden_record(support::nothing, 0.01));
  for (const auto& structure : test_disturbances(fit, RunContext{}))
    EXPECT_LT(structure.sigma, 3.5);
}

TEST(Structure, RatesAreThoseOfThePath) {
  const Assimilation fit = support::assimilated(support::hidden_record(support::nothing, 0.01));
  const Vector& v = fit.records[0].path.col(1);
  EXPECT_NEAR(rate_rms(fit)[0], std::sqrt(v.squaredNorm() / static_cast<double>(v.size())),
              0.02 * rate_rms(fit)[0]);
}

TEST(Structure, TheTotalCountsEveryEquationInUnitsOfItsRate) {
  Assimilation fit = support::assimilated(support::hidden_record(support::nothing, 0.01));
  fit.noise.disturbance = Vector{{0.2, 0.6}};
  EXPECT_NEAR(total_disturbance(fit, Vector{{2.0, 3.0}}), 0.01 + 0.04, 1e-15);
  EXPECT_NEAR(total_disturbance(fit, Vector{{0.0, 3.0}}), 0.04, 1e-15) << "a state at rest";
}

}  // namespace
}  // namespace lacuna
