// SPDX-License-Identifier: MIT
#include "trajectories/smoother/variance_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/data/records/marks.hpp"
#include "support/driven_oscillator.hpp"
#include "support/joint_gaussian.hpp"

namespace lacuna {
namespace {

using support::GaussianCase;

// Responses of the innovations against the filter run again on a record with the term in it.
/// Of so many states, the first not measured, the last with coloured noise; of an even number
/// of states with white noise only.
GaussianCase case_of(Index m) {
  GaussianCase made = support::random_case(m, 20, 9);
  if (m > 1) made.noise.measurement[0].reset();
  if (m % 2 == 1)
    made.noise.coloured[static_cast<std::size_t>(m - 1)] = ColouredNoise{0.3, 0.25};
  made.omitted = Matrix::Zero(20, m);
  made.omitted(5, m - 1) = 1.0;
  return made;
}

InnovationFilter filtered(const GaussianCase& made, const Matrix& measured) {
  return run_filter(made.record, measured, made.omitted, made.noise);
}

/// What a rate in an equation adds to the states: d+ = Phi d + w0 g + w1 g(mid) + w2 g+.
Matrix moved_by(const GaussianCase& made, Index equation, const Vector& rate) {
  const LinearisedRecord& record = made.record;
  const Index m = record.states();
  Matrix moved = Matrix::Zero(record.samples(), m);
  for (Index i = 0; i < record.steps(); ++i) {
    const Eigen::Map<const Matrix> phi(record.transition.col(i).data(), m, m);
    const Eigen::Map<const Matrix> w(record.response.col(i).data() + 3 * m * equation, m, 3);
    moved.row(i + 1) =
        (phi * moved.row(i).transpose() + w * rate.segment(2 * i, 3)).transpose();
  }
  return moved;
}

TEST(ColumnResponse, IsWhatATermInTheRecordDoesToTheInnovations) {
  for (const Index m : {1, 2, 3, 4, 8, 9, 10}) {
    const GaussianCase made = case_of(m);
    const InnovationFilter filter = filtered(made, made.measured);
    Random random(1);
    for (const Index count : {1, 2, 3, 9, 10}) {
      const Matrix values = support::random_matrix(random, 39, count, 1.0);
      Matrix columns(filter.channels * 20, count);
      column_response(made.record, filter, m - 1, values, columns);
      for (Index c = 0; c < count; ++c) {
        const Matrix with = made.measured + moved_by(made, m - 1, values.col(c));
        const Vector expected =
            (filtered(made, with).innovations - filter.innovations).reshaped();
        EXPECT_LT((columns.col(c) - expected).norm(), 1e-9) << m << " states, column " << c;
      }
    }
  }
}

TEST(ChannelResponse, IsWhatAnAdditionToTheMeasurementDoes) {
  for (const Index m : {1, 2, 3, 4, 8, 9, 10}) {
    const GaussianCase made = case_of(m);
    const InnovationFilter filter = filtered(made, made.measured);
    Random random(2);
    const Matrix values = support::random_matrix(random, 20, 3, 1.0);
    Matrix columns(filter.channels * 20, 3);
    channel_response(made.record, filter, m - 1, values, columns);
    for (Index c = 0; c < 3; ++c) {
      Matrix with = made.measured;
      with.col(m - 1) += values.col(c);
      const Vector expected =
          (filtered(made, with).innovations - filter.innovations).reshaped();
      EXPECT_LT((columns.col(c) - expected).norm(), 1e-9) << m << " states, column " << c;
    }
  }
}

struct VarianceCase {
  Dataset data;
  std::vector<LinearisedRecord> records;
  std::vector<Matrix> measured, omitted;

  LinearisedData view() const { return {records, measured, omitted}; }
};

VarianceCase make_variance_case(const support::Hidden& hidden) {
  VarianceCase made{support::hidden_record(hidden, 0.01), {}, {}, {}};
  const Trajectory& record = made.data.trajectories.front();
  made.records.push_back(
      linearise(support::oscillator(), record, record.states, Vector::Constant(2, 1e-4)));
  made.measured.push_back(record.states);
  return made;
}

NoiseModel noise_of(double white, double disturbance) {
  NoiseModel noise;
  noise.measurement = {white, white};
  noise.coloured.resize(2);
  noise.disturbance = Vector{{0.0, disturbance}};
  return noise;
}

double deviance_of(const VarianceCase& made, const NoiseModel& noise) {
  return filter_deviance(made.records[0], made.measured[0], Matrix(), noise);
}

TEST(VarianceFit, GradientIsThatOfTheDeviance) {
  const VarianceCase made = make_variance_case(support::nothing);
  NoiseModel noise = noise_of(0.015, 0.05);
  noise.coloured[0] = ColouredNoise{0.01, 0.3};
  const SmoothedNoise here = VarianceFit(Vector::Constant(2, 1e-9)).run(made.view(), noise, 0);
  const double reach = 1e-4;
  NoiseModel above = noise, below = noise;
  above.disturbance[1] *= std::exp(reach);
  below.disturbance[1] *= std::exp(-reach);
  EXPECT_NEAR((deviance_of(made, above) - deviance_of(made, below)) / (2.0 * reach),
              here.gradient[0], 0.01 * std::abs(here.gradient[0]));
  above = below = noise;
  above.coloured[0]->deviation *= std::exp(reach);
  below.coloured[0]->deviation *= std::exp(-reach);
  EXPECT_NEAR((deviance_of(made, above) - deviance_of(made, below)) / (2.0 * reach),
              here.gradient[2], 0.001 * std::abs(here.gradient[2]));
}

TEST(VarianceFit, SamplesAtAnEndBiasNoNoise) {
  // A third of the samples of v are at an end; taken for values they would be noise of 0.2.
  VarianceCase made = make_variance_case(support::nothing);
  Matrix marks = Matrix::Zero(made.measured[0].rows(), 2);
  auto v = made.measured[0].col(1).array();
  for (Index i = 0; i < marks.rows(); ++i)
    marks(i, 1) = v[i] >= 0.4 ? number_of(Mark::AtTop) : number_of(Mark::Value);
  v = v.min(0.4);
  made.omitted = {marks};
  ASSERT_GT((marks.col(1).array() > 0.0).count(), marks.rows() / 4);
  const SmoothedNoise found =
      VarianceFit(Vector::Constant(2, 1e-9)).run(made.view(), noise_of(0.05, 0.1), 40);
  EXPECT_NEAR(*found.noise.measurement[0], 0.01, 0.001);
  EXPECT_NEAR(*found.noise.measurement[1], 0.02, 0.002);
}

TEST(VarianceFit, OnALatticeItEndsWhereFurtherStepsLeadNowhere) {
  VarianceCase made =
      make_variance_case([](double t, double, double) { return std::sin(3.0 * t); });
  const double lattice = 0.4;
  made.measured[0].col(0) =
      lattice * (made.measured[0].col(0).array() / lattice).round().matrix();
  NoiseModel start = noise_of(0.02, 0.5);
  start.lattice = {lattice, 0.0};
  const SmoothedNoise found =
      VarianceFit(Vector::Constant(2, 0.05 * lattice)).run(made.view(), start, 100);
  EXPECT_LT(found.runs, 50) << "a step that was refused is not tried until the end";
  NoiseModel other = found.noise;
  for (const double factor : {0.8, 1.25}) {
    other.disturbance[1] = factor * found.noise.disturbance[1];
    EXPECT_GT(deviance_of(made, other), found.deviance - 2.0);
  }
}

TEST(VarianceFit, WhatIsKnownOfTheCurvatureDoesNotMoveTheAnswer) {
  const VarianceCase made =
      make_variance_case([](double t, double, double) { return std::sin(3.0 * t); });
  const Vector floor = Vector::Constant(2, 1e-9);
  VarianceFit first(floor);
  const SmoothedNoise found = first.run(made.view(), noise_of(0.02, 0.1), 40);
  NoiseCurvature much_too_steep = first.curvature();
  much_too_steep.inverse *= 1e-6;
  for (const NoiseCurvature& known : {first.curvature(), much_too_steep})
    EXPECT_NEAR(VarianceFit(floor, known).run(made.view(), noise_of(0.05, 1.0), 40).deviance,
                found.deviance, 0.05);
}

TEST(VarianceFit, WhiteNoiseStaysAboveItsFloor) {
  const VarianceCase made = make_variance_case(support::nothing);
  const SmoothedNoise found =
      VarianceFit(Vector::Constant(2, 0.05)).run(made.view(), noise_of(0.06, 0.01), 20);
  EXPECT_GE(*found.noise.measurement[0], 0.05);
}

/// What VarianceFit sees of a case.
struct GaussianData {
  explicit GaussianData(const support::GaussianCase& made)
      : records{made.record}, measured{made.measured} {
    if (made.omitted.size() > 0) omitted.push_back(made.omitted);
  }

  LinearisedData view() const { return {records, measured, omitted}; }

  std::vector<LinearisedRecord> records;
  std::vector<Matrix> measured, omitted;
};

TEST(VarianceFit, ReachesTheLargestLikelihoodWithColouredNoise) {
  support::GaussianCase made = support::random_case(1, 80, 4);
  made.noise.coloured[0] = ColouredNoise{0.5, 0.3};
  made.noise.disturbance[0] = 1.5;
  made = support::drawn(made, 6);
  const double least = support::least_joint_deviance(made, [](NoiseModel& noise) {
    return std::vector<double*>{&noise.disturbance[0], &*noise.measurement[0],
                                &noise.coloured[0]->deviation};
  });
  for (const double factor : {0.5, 2.0}) {
    NoiseModel start = made.noise;
    start.disturbance[0] *= factor;
    start.coloured[0]->deviation *= factor;
    const SmoothedNoise found =
        VarianceFit(Vector::Constant(1, 1e-9)).run(GaussianData(made).view(), start, 60);
    EXPECT_NEAR(found.deviance, least, 0.25) << factor;  // half a standard deviation
  }
}

TEST(VarianceFit, WhiteNoiseMovesOnlyWhereItMay) {
  const support::GaussianCase made = support::drawn(support::random_case(1, 80, 4), 6);
  NoiseModel start = made.noise;
  *start.measurement[0] *= 3.0;
  VarianceFit fit(Vector::Constant(1, 1e-9));
  fit.set_white_moves(false);
  const SmoothedNoise found = fit.run(GaussianData(made).view(), start, 40);
  EXPECT_EQ(*found.noise.measurement[0], *start.measurement[0]);
  EXPECT_EQ(found.gradient.size(), 1);
  fit.set_white_moves(true);
  EXPECT_LT(fit.run(GaussianData(made).view(), found.noise, 40).deviance, found.deviance - 1.0);
}

/// The disturbance of one step does not reach the next one. Nearly all samples measure it
/// directly and are of size 1; the last one measures a 200th of its variance in noise of
/// variance 1, and is far off: sqrt(`outlier`).
support::GaussianCase two_scales(double outlier) {
  constexpr Index kSamples = 102;
  support::GaussianCase made = support::random_case(2, kSamples, 1);
  LinearisedRecord& record = made.record;
  record.time = Vector::LinSpaced(kSamples, 0.0, kSamples - 1.0);
  record.path.setZero();
  record.transition.setZero();
  record.defect.setZero();
  record.response.setZero();
  record.response.row(0).setOnes();
  record.response.row(1).setConstant(std::sqrt(1.0 / 200.0));
  made.noise.measurement = {1e-4, 1.0};
  made.noise.disturbance = Vector{{1.0, 0.0}};
  made.measured.setZero();
  made.measured.col(0).setOnes();
  made.measured(kSamples - 1, 1) = std::sqrt(outlier);
  made.omitted = Matrix::Ones(kSamples, 2);
  made.omitted.col(0).segment(1, kSamples - 2).setZero();
  made.omitted(kSamples - 1, 1) = 0.0;
  return made;
}

/// Its deviance: 100 log q + 100 / q + log S + outlier / S, S = 1 + q / 200.
double deviance_of_two_scales(double q, double outlier) {
  const double s = 1.0 + q / 200.0;
  return 100.0 * (std::log(q + 1e-8) + 1.0 / (q + 1e-8)) + std::log(s) + outlier / s;
}

TEST(VarianceFit, ComesBackFromAStepOverAHump) {
  constexpr double kOutlier = 1700.0;
  const support::GaussianCase made = two_scales(kOutlier);
  NoiseModel start = made.noise;
  start.disturbance[0] = std::sqrt(0.95);
  // The first step goes over a hump, to where the deviance falls more steeply than here.
  const double there = 0.95 * std::exp(3.0), h = 1e-4;
  ASSERT_GT(deviance_of_two_scales(there, kOutlier), deviance_of_two_scales(0.95, kOutlier));
  ASSERT_LT(deviance_of_two_scales(there * (1.0 + h), kOutlier) -
                deviance_of_two_scales(there, kOutlier),
            deviance_of_two_scales(0.95 * (1.0 + h), kOutlier) -
                deviance_of_two_scales(0.95, kOutlier));
  const NoiseCurvature flat{{{NoiseEntry::Kind::Disturbance, 0}}, Matrix::Constant(1, 1, 5.0)};
  VarianceFit fit(Vector::Constant(2, 1e-9), flat);
  fit.set_white_moves(false);
  const SmoothedNoise found = fit.run(GaussianData(made).view(), start, 12);
  double least = deviance_of_two_scales(0.95, kOutlier);
  for (double q = 0.5; q < 5.0; q *= 1.001)
    least = std::min(least, deviance_of_two_scales(q, kOutlier));
  EXPECT_NEAR(found.deviance, least, 0.05);
}

TEST(VarianceFit, LearnsTheCurvature) {
  const support::GaussianCase made = two_scales(0.0);
  NoiseModel start = made.noise;
  start.disturbance[0] = 1.3;
  VarianceFit fit(Vector::Constant(2, 1e-9));
  fit.set_white_moves(false);
  const SmoothedNoise found = fit.run(GaussianData(made).view(), start, 40);
  EXPECT_NEAR(found.noise.disturbance[0], 1.0, 0.01);
  ASSERT_EQ(fit.curvature().entries.size(), 1u);
  EXPECT_EQ(fit.curvature().entries[0], (NoiseEntry{NoiseEntry::Kind::Disturbance, 0}));
  // d^2 / d(log s)^2 of 100 (2 log s + 1 / s^2) is 400 at s = 1.
  EXPECT_NEAR(fit.curvature().inverse(0, 0), 1.0 / 400.0, 0.1 / 400.0);
}

TEST(VarianceFit, CurvatureOfOtherDeviationsIsForgotten) {
  const support::GaussianCase made = two_scales(0.0);
  const NoiseCurvature other{{{NoiseEntry::Kind::Disturbance, 1}}, Matrix::Constant(1, 1, 0.3)};
  VarianceFit fit(Vector::Constant(2, 1e-9), other);
  fit.set_white_moves(false);
  const SmoothedNoise here = fit.run(GaussianData(made).view(), made.noise, 0);
  ASSERT_EQ(fit.curvature().inverse.rows(), 1);
  EXPECT_NEAR(fit.curvature().inverse(0, 0), 0.25 / here.weight[0], 1e-12);
}

}  // namespace
}  // namespace lacuna
