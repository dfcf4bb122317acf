// SPDX-License-Identifier: MIT
#include "lacuna/innovation/innovation_filter.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/error.hpp"
#include "support/driven_oscillator.hpp"

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
