// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/smoother/innovation_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "support/driven_oscillator.hpp"
#include "support/joint_gaussian.hpp"

namespace lacuna {
namespace {

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

double mean_square(const InnovationFilter& filter) {
  return filter.innovations.squaredNorm() / static_cast<double>(filter.used);
}

TEST(InnovationFilter, InnovationsOfACompleteModelAreWhite) {
  const Case made = make_case(support::nothing);
  const InnovationFilter filter =
      run_filter(made.record, made.data.trajectories[0].states, Matrix(), noise_of(0.0));
  EXPECT_EQ(filter.used, 3002);
  EXPECT_NEAR(mean_square(filter), 1.0, 0.1);
  const auto row = filter.innovations.row(1);
  const double neighbours = row.head(1500).dot(row.tail(1500)) / row.squaredNorm();
  EXPECT_LT(std::abs(neighbours), 0.08);
}

TEST(InnovationFilter, InnovationsAreTheResponseToWhatIsMissing) {
  const Case made = make_case([](double, double, double v) { return -0.3 * (v > 0 ? 1 : -1); });
  const InnovationFilter filter =
      run_filter(made.record, made.data.trajectories[0].states, Matrix(), noise_of(0.0));
  EXPECT_GT(mean_square(filter), 3.0);
  Vector sign = made.record.slots.col(1);
  for (double& v : sign) v = v > 0 ? 1.0 : -1.0;
  Matrix column(3002, 1);
  column_response(made.record, filter, 1, sign, column);
  const double coefficient =
      column.cwiseProduct(filter.innovations.reshaped()).sum() / column.squaredNorm();
  EXPECT_NEAR(coefficient, -0.3, 0.01);
  // The sign is that of the measured velocity here, wrong at some samples where it is small.
  EXPECT_LT((filter.innovations.reshaped() - coefficient * column).squaredNorm() / 3002.0, 1.4);
}

TEST(InnovationFilter, ChannelResponseIsWhatAnOffsetOfTheSensorDoes) {
  Case made = make_case(support::nothing);
  Matrix measured = made.data.trajectories[0].states;
  const InnovationFilter before = run_filter(made.record, measured, Matrix(), noise_of(0.1));
  measured.col(0).array() += 0.05;
  const InnovationFilter after = run_filter(made.record, measured, Matrix(), noise_of(0.1));
  Matrix column(3002, 1);
  channel_response(made.record, after, 0, Vector::Ones(1501), column);
  EXPECT_LT(((after.innovations - before.innovations).reshaped() - 0.05 * column).norm(), 1e-9);
}

TEST(InnovationFilter, OmittedSamplesAreNotUsed) {
  const Case made = make_case(support::nothing);
  Matrix measured = made.data.trajectories[0].states;
  Matrix omitted = Matrix::Zero(1501, 2);
  measured(700, 0) += 5.0;
  omitted(700, 0) = 1.0;
  const InnovationFilter filter = run_filter(made.record, measured, omitted, noise_of(0.0));
  EXPECT_EQ(filter.used, 3001);
  EXPECT_NEAR(mean_square(filter), 1.0, 0.1);
}

TEST(InnovationFilter, SmootherFindsTheVariancesThatTheFilterAsksFor) {
  const Case made = make_case(support::nothing);
  const SmoothedRecord smoothed =
      smooth(made.record, made.data.trajectories[0].states, Matrix(), noise_of(0.0));
  for (Index channel = 2; channel < 4; ++channel)
    EXPECT_NEAR(smoothed.found[channel] / smoothed.expected[channel], 1.0, 0.1);
  EXPECT_LT(smoothed.found[1] / smoothed.expected[1], 3.0) << "no disturbance is asked for";
}

TEST(InnovationFilter, DevianceIsThatOfTheFilter) {
  const Case made = make_case(support::nothing);
  const Matrix& measured = made.data.trajectories[0].states;
  EXPECT_NEAR(filter_deviance(made.record, measured, Matrix(), noise_of(0.1)),
              run_filter(made.record, measured, Matrix(), noise_of(0.1)).deviance, 1e-6);
  EXPECT_THROW(run_filter(made.record, Matrix::Zero(4, 2), Matrix(), noise_of(0.1)),
               ArgumentError);
}

/// log det S + r' S^-1 r of all measurements r, whose covariance S is written out.
double joint_deviance(const LinearisedRecord& record, const Matrix& measured,
                      const NoiseModel& noise) {
  const Index n = record.samples();
  const double step = record.time[1] - record.time[0];
  const Vector span = record.path.colwise().maxCoeff() - record.path.colwise().minCoeff();
  // What moves the deviations: both at the start, then the disturbance of v in each step.
  Matrix from = Matrix::Zero(2 * n, 2 + n - 1);
  from.topLeftCorner(2, 2) = span.asDiagonal();
  Vector left(2 * n), shift = Vector::Zero(2);
  for (Index i = 0; i < n; ++i) {
    left.segment(2 * i, 2) = (measured.row(i) - record.path.row(i)).transpose() - shift;
    if (i + 1 == n) break;
    const Eigen::Map<const Matrix> phi(record.transition.col(i).data(), 2, 2);
    from.middleRows(2 * i + 2, 2) = phi * from.middleRows(2 * i, 2);
    const auto w = record.response.col(i).tail(6);
    from.block(2 * i + 2, 2 + i, 2, 1) = noise.disturbance[1] / std::sqrt(step) *
                                         (w.segment(0, 2) + w.segment(2, 2) + w.tail(2));
    shift = phi * shift + record.defect.col(i);
  }
  Matrix covariance = from * from.transpose();
  for (Index i = 0; i < 2 * n; ++i) {
    covariance(i, i) += std::pow(*noise.measurement[static_cast<std::size_t>(i % 2)], 2);
    for (Index j = 0; i % 2 == 0 && j < 2 * n; j += 2)
      covariance(i, j) += std::pow(noise.coloured[0]->deviation, 2) *
                          std::exp(-std::abs(record.time[i / 2] - record.time[j / 2]) /
                                   noise.coloured[0]->time);
  }
  const Eigen::LLT<Matrix> factor(covariance);
  return 2.0 * Matrix(factor.matrixL()).diagonal().array().log().sum() +
         left.dot(factor.solve(left));
}

TEST(InnovationFilter, DevianceIsThatOfTheJointGaussian) {
  const Case made = make_case([](double t, double, double) { return std::sin(3.0 * t); });
  const LinearisedRecord record = part_of(made.record, 100, 40);
  const Matrix measured = made.data.trajectories[0].states.middleRows(100, 40);
  NoiseModel noise = noise_of(0.3);
  noise.coloured[0] = ColouredNoise{0.03, 0.1};
  const double expected = joint_deviance(record, measured, noise);
  EXPECT_NEAR(filter_deviance(record, measured, Matrix(), noise), expected, 1e-6);
  EXPECT_NEAR(smooth(record, measured, Matrix(), noise).deviance, expected, 1e-6);
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

TEST(InnovationFilter, TermsGoThroughTheRecordAloneAsTogether) {
  const Case made = make_case(support::nothing);
  NoiseModel noise = noise_of(0.1);
  noise.coloured[1] = ColouredNoise{0.01, 0.3};
  const InnovationFilter filter =
      run_filter(made.record, made.data.trajectories[0].states, Matrix(), noise);
  const Matrix values = made.record.slots.leftCols(3);
  Matrix together(3002, 3), alone(3002, 1);
  column_response(made.record, filter, 1, values, together);
  for (Index k = 0; k < 3; ++k) {
    column_response(made.record, filter, 1, values.col(k), alone);
    EXPECT_LT((alone - together.col(k)).norm(), 1e-12 * alone.norm());
  }
}

TEST(InnovationFilter, ABridgedStepForgivesAndTellsNothing) {
  Case made = make_case(support::nothing);
  Trajectory& record = made.data.trajectories[0];
  record.states.col(1).tail(1000).array() += 1.0;  // a jump of the velocity after step 500
  const double without = filter_deviance(made.record, record.states, Matrix(), noise_of(0.0));
  const Vector expected = smooth(made.record, record.states, Matrix(), noise_of(0.1)).expected;
  made.record.bridge = Matrix::Zero(2, made.record.steps());
  made.record.bridge(1, 500) = 100.0;
  EXPECT_LT(filter_deviance(made.record, record.states, Matrix(), noise_of(0.0)), without);
  const SmoothedRecord bridged = smooth(made.record, record.states, Matrix(), noise_of(0.1));
  EXPECT_NE(bridged.expected[1], expected[1]);
  EXPECT_GT(std::abs(bridged.disturbance(500, 1)),
            10.0 * std::abs(bridged.disturbance(400, 1)));
}

}  // namespace
}  // namespace lacuna
