// SPDX-License-Identifier: MIT
// What samples show of disturbances, outliers, tones and clocks.
#include "lacuna/trajectories/smoother/disturbance_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/joint_gaussian.hpp"
#include "trajectories/smoother/outlier_check.hpp"
#include "trajectories/smoother/spectral_lines.hpp"
#include "trajectories/smoother/timing_jitter.hpp"

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

TEST(OutlierCheck, KeepsWhatThePathDoesNotExplain) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories[0].states(200, 0) += 0.5;
  Matrix marks = Matrix::Zero(data.samples(), 2);
  marks(200, 0) = 1.0;
  marks(300, 0) = 1.0;  // a sample like others
  const Assimilation fit = assimilate(support::oscillator(), as_measured(data, {marks}),
                                      support::oscillator_fit_options(), RunContext{});
  const OutlierCheck check = check_outliers(data.states, fit);
  EXPECT_TRUE(check.any_false);
  EXPECT_EQ(check.outliers[0](200, 0), 1.0);
  EXPECT_EQ(check.outliers[0].sum(), 1.0);
  EXPECT_THAT(check.notes, ::testing::ElementsAre("1 outlier of q was left out"));
}

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

/// The oscillator, its states moved along their rates by a time that scatters. @param shared
/// whether both states are taken at one time.
Dataset scattered(double deviation, bool shared) {
  Dataset data = support::hidden_record(support::nothing, 0.002);
  Trajectory& record = data.trajectories[0];
  const Matrix states = record.states;
  Random random(7);
  for (Index i = 1; i + 1 < record.samples(); ++i) {
    double late = deviation * random.normal();
    for (Index k = 0; k < 2; ++k) {
      const double rate =
          (states(i + 1, k) - states(i - 1, k)) / (record.time[i + 1] - record.time[i - 1]);
      record.states(i, k) += late * rate;
      if (!shared) late = deviation * random.normal();
    }
  }
  return data;
}

TEST(TimingJitter, IsHowFarTheTimesScatter) {
  for (const bool shared : {true, false}) {
    const TimingJitter found = timing_jitter(support::assimilated(scattered(0.01, shared)));
    EXPECT_NEAR(found.deviation, shared ? 0.01 : 0.008, 0.002);
    EXPECT_GT(found.sigma, 5.0);
    EXPECT_GT(found.fraction, 0.5);
  }
}

}  // namespace
}  // namespace lacuna
