// SPDX-License-Identifier: MIT
// States and noise of a record by the smoother.
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "lacuna/trajectories/smoother/assimilation.hpp"
#include "lacuna/trajectories/smoother/innovation_filter.hpp"
#include "support/driven_oscillator.hpp"
#include "support/joint_gaussian.hpp"
#include "support/one_record.hpp"
#include "trajectories/smoother/innovation_system.hpp"
#include "trajectories/smoother/kalman_step.hpp"

namespace lacuna {
namespace {

using support::GaussianCase;
using support::JointGaussian;

TEST(DevianceSum, HoldsScalesOfAnySize) {
  DevianceSum sum;
  for (const double scale : {1e-300, 1e300, 1e-90, 1e-90, 1e90, 1e90, 1e90})
    sum.add({0.0, 1.0, 0.0, scale});
  EXPECT_NEAR(sum.value(), 90.0 * std::log(10.0), 1e-9);
  sum.add({0.0, INFINITY, 0.5, 1.0});
  EXPECT_NEAR(sum.value(), 0.5 + 90.0 * std::log(10.0), 1e-9) << "a sample that says nothing";
}

constexpr double kNoise = 0.01;

NoiseModel noise_of(double disturbance) {
  Vector q(2);
  q << 0.0, disturbance;
  return {{kNoise, 2.0 * kNoise}, {{}, {}}, q};
}

struct Case {
  Dataset data;
  LinearisedRecord record;
};

Case make_case(const support::Hidden& hidden) {
  Case made{support::hidden_record(hidden, kNoise), {}};
  const Trajectory& record = made.data.trajectories.front();
  made.record =
      linearise(support::oscillator(), record, record.states, Vector::Constant(2, 1e-4));
  return made;
}

TEST(InnovationFilter, DevianceIsThatOfTheFilter) {
  const Case made = make_case(support::nothing);
  const Matrix& measured = made.data.trajectories[0].states;
  EXPECT_NEAR(filter_deviance(made.record, measured, Matrix(), noise_of(0.1)),
              run_filter(made.record, measured, Matrix(), noise_of(0.1)).deviance, 1e-6);
  EXPECT_THROW(run_filter(made.record, Matrix::Zero(4, 2), Matrix(), noise_of(0.1)),
               ArgumentError);
}

TEST(InnovationFilter, WhitensAsTheCholeskyFactorOfTheCovarianceDoes) {
  support::GaussianCase made = support::random_case(3, 20, 11);
  made.noise.measurement[1].reset();
  made.noise.coloured[2] = ColouredNoise{0.3, 0.25};
  made.record.bridge = Matrix::Zero(3, 19);
  made.record.bridge(0, 9) = 40.0;
  const InnovationFilter filter = run_filter(made.record, made.measured, Matrix(), made.noise);
  const support::JointGaussian joint = support::joint_of(made);
  const Matrix factor = support::measured_covariance(joint).matrixL();
  const Vector expected = factor.triangularView<Eigen::Lower>().solve(joint.left);
  EXPECT_LT((filter.innovations.reshaped() - expected).norm(), 1e-8);
  EXPECT_LT((filter.inverse_deviation.reshaped() - factor.diagonal().cwiseInverse()).norm(),
            1e-8);
  EXPECT_EQ(filter.used, 40);
  EXPECT_NEAR(filter.deviance, support::joint_deviance(made), 1e-7);
}

// The smoother against the conditional mean of the joint Gaussian, and its sums against finite
// differences of the likelihood.
/// Three states, the second not measured, the third with coloured noise, samples left out and a
/// step that is bridged.
GaussianCase mixed_case() {
  GaussianCase made = support::random_case(3, 24, 5);
  made.noise.measurement[1].reset();
  made.noise.coloured[2] = ColouredNoise{0.3, 0.25};
  made.omitted = Matrix::Zero(24, 3);
  made.omitted(0, 0) = made.omitted(7, 2) = made.omitted(8, 2) = made.omitted(8, 0) = 1.0;
  made.record.bridge = Matrix::Zero(3, 23);
  made.record.bridge(1, 12) = 40.0;
  return made;
}

SmoothedRecord smoothed(const GaussianCase& made) {
  return smooth(made.record, made.measured, made.omitted, made.noise);
}

TEST(Smoother, IsTheConditionalMeanOfTheJointGaussian) {
  for (const GaussianCase& made :
       {mixed_case(), support::random_case(1, 30, 2), support::random_case(2, 12, 3),
        support::random_case(4, 9, 6), support::random_case(5, 8, 7),
        support::random_case(9, 6, 4), support::random_case(17, 5, 8)}) {
    const JointGaussian joint = support::joint_of(made);
    const Vector z = support::posterior(joint);
    const SmoothedRecord found = smoothed(made);
    const Vector expected = joint.mean + joint.deviations * z;
    EXPECT_LT((found.deviation.transpose().reshaped() - expected).cwiseAbs().maxCoeff(), 1e-8);
    const Vector rates = joint.rates * z;
    EXPECT_LT((found.disturbance.transpose().reshaped() - rates).cwiseAbs().maxCoeff(),
              1e-8 * rates.cwiseAbs().maxCoeff());
    EXPECT_NEAR(found.deviance, support::joint_deviance(made), 1e-7);
  }
}

TEST(Smoother, FindsTheColouredNoise) {
  const GaussianCase made = mixed_case();
  const JointGaussian joint = support::joint_of(made);
  const Vector expected = joint.noise[2] * support::posterior(joint);
  const SmoothedRecord found = smoothed(made);
  ASSERT_EQ(found.colour.cols(), 2) << "one column for each measured state";
  EXPECT_LT((found.colour.col(1) - expected).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(found.colour.col(0).norm(), 0.0) << "the first channel has none";
}

/// Central difference of the joint deviance over the logarithm of a deviation.
template <class Change>
double slope(const GaussianCase& made, Change deviation) {
  constexpr double kReach = 1e-4;
  GaussianCase above = made, below = made;
  deviation(above.noise) *= std::exp(kReach);
  deviation(below.noise) *= std::exp(-kReach);
  return (support::joint_deviance(above) - support::joint_deviance(below)) / (2.0 * kReach);
}

TEST(Smoother, SumsAreTheGradientOfTheLikelihood) {
  const GaussianCase made = mixed_case();
  const SmoothedRecord found = smoothed(made);
  ASSERT_EQ(found.found.size(), 3 + 2 + 2);
  const auto gradient = [&](Index sum, double s) {
    return 2.0 * s * s * (found.expected[sum] - found.found[sum]);
  };
  for (Index k = 0; k < 3; ++k) {
    const double expected =
        slope(made, [k](NoiseModel& noise) -> double& { return noise.disturbance[k]; });
    EXPECT_NEAR(gradient(k, made.noise.disturbance[k]), expected, 1e-5 * std::abs(expected));
  }
  const std::size_t states[] = {0, 2};
  for (Index c = 0; c < 2; ++c) {
    const std::size_t k = states[c];
    const double expected =
        slope(made, [k](NoiseModel& noise) -> double& { return *noise.measurement[k]; });
    EXPECT_NEAR(gradient(3 + c, *made.noise.measurement[k]), expected,
                1e-5 * std::abs(expected));
  }
}

TEST(Smoother, SumsOfColouredNoiseAreTheGradientToo) {
  for (const double time : {0.15, 2.0, 20.0}) {  // short, as long as the record, longer
    GaussianCase made = support::random_case(1, 24, 4);
    made.noise.coloured[0] = ColouredNoise{0.5, time};
    made = support::drawn(made, 6);
    made.omitted = Matrix::Zero(24, 1);
    made.omitted(0, 0) = 1.0;
    const SmoothedRecord found = smoothed(made);
    const double s = made.noise.coloured[0]->deviation;
    const double expected =
        slope(made, [](NoiseModel& noise) -> double& { return noise.coloured[0]->deviation; });
    EXPECT_NEAR(2.0 * s * s * (found.expected[2] - found.found[2]), expected,
                1e-5 * std::abs(expected))
        << time;
  }
}

TEST(Smoother, WithoutDisturbancesThePathIsASolution) {
  GaussianCase made = support::random_case(2, 15, 8);
  made.noise.disturbance.setZero();
  const SmoothedRecord found = smoothed(made);
  EXPECT_EQ(found.disturbance.norm(), 0.0);
  for (Index i = 0; i + 1 < 15; ++i) {
    const Eigen::Map<const Matrix> phi(made.record.transition.col(i).data(), 2, 2);
    const Vector next = phi * found.deviation.row(i).transpose() + made.record.defect.col(i);
    EXPECT_LT((found.deviation.row(i + 1).transpose() - next).norm(), 1e-9) << i;
  }
}

Assimilation fitted(const Dataset& data, std::vector<CoefficientPrior> priors = {}) {
  AssimilationOptions options;
  options.free = free_coefficients(support::oscillator());
  options.priors = std::move(priors);
  return assimilate(support::oscillator(), as_measured(data), options, RunContext{});
}

Dataset softer_spring() {
  return support::hidden_record([](double, double q, double) { return 0.4 * q; }, 0.01);
}

TEST(Assimilation, GrowthAtUnitRateIsNoIdentity) {
  const Variables x{{"x"}, {}};
  const OdeModel growth({{"x", ""}}, {}, {{{Term::parse("x", x), 1.0}}});
  const std::vector<CoefficientPlace> only{{0, 0}};
  EXPECT_EQ(free_coefficients(growth), only);
  Trajectory record;
  record.time = Vector::LinSpaced(200, 0.0, 2.0);
  record.states = (1.1 * record.time.array()).exp();
  Dataset data = support::one_record(growth.states(), {}, record);
  AssimilationOptions options;
  options.free = free_coefficients(growth);
  const Assimilation fit = assimilate(growth, as_measured(data), options, RunContext{});
  EXPECT_NEAR(fit.model.coefficient(0, "x"), 1.1, 1e-3);
}

TEST(Assimilation, KeepsWhatTheModelSaysBesideItsEquations) {
  const OdeModel model = support::oscillator()
                             .with_initial({InitialValue{.value = 1.5}, std::nullopt})
                             .with_outputs({{"angle", "m", parse_expression("q")}});
  AssimilationOptions options;
  options.free = free_coefficients(model);
  const OdeModel fit =
      assimilate(model, as_measured(softer_spring()), options, RunContext{}).model;
  ASSERT_TRUE(fit.initial()[0].has_value());
  EXPECT_EQ(fit.initial()[0]->value, 1.5);
  ASSERT_EQ(fit.outputs().size(), 1U);
  EXPECT_EQ(fit.outputs()[0].name, "angle");
}

TEST(Assimilation, TakesTheNoiseThatTheRecordsCarry) {
  BoundRecords records = as_measured(softer_spring());
  EXPECT_EQ(assimilate(support::oscillator(), records, {}, RunContext{}).estimated_noise,
            visible_noise(records));
  records.channels[1].noise.white = 0.5;
  EXPECT_EQ(assimilate(support::oscillator(), records, {}, RunContext{}).estimated_noise[1],
            0.5);
}

TEST(Assimilation, FindsCoefficientsAndNoise) {
  const Assimilation fit = fitted(softer_spring());
  EXPECT_NEAR(fit.model.coefficient(1, "q"), -3.6, 0.02);
  EXPECT_NEAR(fit.model.coefficient(1, "F"), 1.0, 0.01);
  EXPECT_NEAR(*fit.noise.measurement[0], 0.01, 1e-3);
  EXPECT_NEAR(*fit.noise.measurement[1], 0.02, 2e-3);
  EXPECT_LT(fit.noise.disturbance[1], 0.02);
  EXPECT_EQ(fit.noise.disturbance[0], 0.0) << "an identity is exact";
}

TEST(Assimilation, TightToleranceHoldsACoefficient) {
  const Assimilation fit = fitted(softer_spring(), {{{1, 0}, -4.0, 1e-6}});
  EXPECT_NEAR(fit.model.coefficient(1, "q"), -4.0, 1e-3);
}

TEST(Assimilation, NoiseThatHasShrunkComesBack) {
  Assimilation fit = fitted(softer_spring());
  EXPECT_FALSE(with_estimated_noise(fit).has_value());
  fit.noise.measurement[1] = 1e-6;
  const auto again = with_estimated_noise(fit);
  ASSERT_TRUE(again.has_value());
  EXPECT_NEAR(*again->noise.measurement[1], 0.02, 0.004);
  EXPECT_EQ(again->noise.measurement[0], fit.noise.measurement[0]);
}

TEST(Assimilation, ValuesOnALatticeShowTheirNoise) {
  Dataset data = support::hidden_record(support::nothing, 0.0);
  for (double& value : data.trajectories.front().states.reshaped())
    value = 0.1 * std::round(10.0 * value);
  const Assimilation fit = fitted(data);
  for (Index k = 0; k < 2; ++k) {
    EXPECT_NEAR(fit.estimated_noise[k], 0.1 / std::sqrt(12.0), 1e-6);
    EXPECT_LT(*fit.noise.measurement[static_cast<std::size_t>(k)], 0.01) << "before rounding";
    EXPECT_NEAR(fit.noise.rounded(static_cast<std::size_t>(k)), 0.03, 0.006);
  }
}

TEST(Assimilation, NoiseWithAMemoryHasTheGivenTime) {
  AssimilationOptions options;
  options.coloured = {ColouredNoise{0.05, 0.3}, std::nullopt};
  const Assimilation fit =
      assimilate(support::oscillator(), as_measured(softer_spring()), options, RunContext{});
  ASSERT_TRUE(fit.noise.coloured[0].has_value());
  EXPECT_EQ(fit.noise.coloured[0]->time, 0.3);
  EXPECT_NE(fit.noise.coloured[0]->deviation, 0.05) << "its size is fitted";
  EXPECT_FALSE(fit.noise.coloured[1].has_value());
}

TEST(Assimilation, StatesMadeFromOthersAreNotMeasurements) {
  Dataset data = softer_spring();
  data.reconstructed = {false, true};
  const Assimilation fit = fitted(data);
  EXPECT_FALSE(fit.noise.measurement[1].has_value());
  EXPECT_NEAR(fit.model.coefficient(1, "q"), -3.6, 0.03);
}

}  // namespace
}  // namespace lacuna
