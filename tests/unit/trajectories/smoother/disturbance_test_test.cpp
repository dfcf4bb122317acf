// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/smoother/disturbance_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/assimilated_oscillator.hpp"
#include "support/joint_gaussian.hpp"

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
  const auto structures = test_disturbances(fit, RunContext{});
  ASSERT_FALSE(structures.empty());
  for (const auto& structure : structures) EXPECT_LT(structure.sigma, 3.5);
}

TEST(Structure, TheTotalCountsEveryEquationInUnitsOfItsRate) {
  Assimilation fit = support::assimilated(support::hidden_record(support::nothing, 0.01));
  fit.noise.disturbance = Vector{{0.2, 0.6}};
  EXPECT_NEAR(total_disturbance(fit, Vector{{2.0, 3.0}}), 0.01 + 0.04, 1e-15);
  EXPECT_NEAR(total_disturbance(fit, Vector{{0.0, 3.0}}), 0.04, 1e-15) << "a state at rest";
}

TEST(Structure, TheFractionThatIsClosedLiesBetweenNoneAndAll) {
  Assimilation before = support::assimilated(support::hidden_record(support::nothing, 0.01));
  Assimilation after = before;
  before.noise.disturbance = Vector{{0.0, 0.6}};
  after.noise.disturbance = Vector{{0.0, 0.3}};
  EXPECT_NEAR(fraction_closed(before, after), 0.75, 1e-12);
  EXPECT_EQ(fraction_closed(after, before), 0.0) << "more than before";
  before.noise.disturbance.setZero();
  EXPECT_EQ(fraction_closed(before, after), 1.0) << "of nothing";
}

/// The case as if a model had been brought onto it.
Assimilation assimilation_of(const support::GaussianCase& made) {
  Assimilation fit{.model = support::oscillator()};
  fit.records = {made.record};
  fit.measured = {made.measured};
  fit.noise = made.noise;
  fit.least_noise = Vector::Constant(2, 1e-9);
  return fit;
}

TEST(Structure, DropIsTheLikelihoodRatioOfTheJointGaussian) {
  const support::GaussianCase made = support::drawn(support::random_case(2, 25, 4), 3);
  const auto structure = test_disturbances(assimilation_of(made), RunContext{});
  ASSERT_EQ(structure.size(), 2u);
  EXPECT_GE(structure[0].drop, structure[1].drop) << "most significant first";
  const auto all = [](NoiseModel& noise) {
    return std::vector<double*>{&noise.disturbance[0], &noise.disturbance[1],
                                &*noise.measurement[0], &*noise.measurement[1]};
  };
  const double now = support::least_joint_deviance(made, all);
  for (const EquationStructure& equation : structure) {
    support::GaussianCase without = made;
    without.noise.disturbance[equation.equation] = 0.0;
    const double drop = support::least_joint_deviance(without, all) - now;
    EXPECT_NEAR(equation.drop, drop, 0.1) << equation.equation;
    // Half chi-squared with one degree of freedom, as a two-sided normal tail.
    EXPECT_NEAR(std::log(std::erfc(equation.sigma / std::sqrt(2.0))),
                std::log(0.5 * std::erfc(std::sqrt(0.5 * equation.drop))), 1e-3);
  }
}

TEST(Structure, SizeIsThatOfTheExpectedDisturbance) {
  const support::GaussianCase made = support::drawn(support::random_case(2, 25, 4), 3);
  const support::JointGaussian joint = support::joint_of(made);
  const Matrix rates = (joint.rates * support::posterior(joint)).reshaped(2, 24).transpose();
  const Assimilation fit = assimilation_of(made);
  EXPECT_LT((disturbance_along(fit, 0) - rates).norm(), 1e-8 * rates.norm());
  const Matrix change = (made.record.path.bottomRows(24) - made.record.path.topRows(24)) / 0.1;
  for (const EquationStructure& equation : test_disturbances(fit, RunContext{})) {
    const double rms = rates.col(equation.equation).norm() / std::sqrt(24.0);
    EXPECT_NEAR(equation.rms, rms, 1e-8 * rms);
    EXPECT_NEAR(equation.relative,
                rms / (change.col(equation.equation).norm() / std::sqrt(24.0)), 1e-8);
  }
}

TEST(Structure, BridgedStepsDoNotCountAsLeftOver) {
  support::GaussianCase made = support::drawn(support::random_case(2, 25, 4), 3);
  made.record.bridge = Matrix::Zero(2, 24);
  made.record.bridge(1, 12) = 1e4;
  made.measured.col(1).tail(12).array() += 50.0;
  const Assimilation fit = assimilation_of(made);
  const Matrix along = disturbance_along(fit, 0);
  double squares = 0.0;
  for (Index i = 0; i < 24; ++i) squares += i == 12 ? 0.0 : along(i, 1) * along(i, 1);
  const auto equations = test_disturbances(fit, RunContext{});
  const auto second = std::find_if(equations.begin(), equations.end(),
                                   [](const auto& each) { return each.equation == 1; });
  ASSERT_NE(second, equations.end());
  EXPECT_NEAR(second->rms, std::sqrt(squares / 23.0), 1e-9);
}

}  // namespace
}  // namespace lacuna
