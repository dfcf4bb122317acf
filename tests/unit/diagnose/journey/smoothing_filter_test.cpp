// SPDX-License-Identifier: MIT
// Filters that records went through before they were written.
#include "diagnose/journey/smoothing_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.hpp"
#include "diagnose/journey/smoothed_records.hpp"
#include "lacuna/data/records/marks.hpp"
#include "support/asked.hpp"

namespace lacuna {
namespace {

using Kind = SmoothingFilter::Kind;

constexpr Index kSamples = 3000;
constexpr int kTurns = SmoothingOptions{}.turns;

/// Two slow waves, one in each column.
Matrix waves(double period = 150.0) {
  Matrix made(kSamples, 2);
  for (Index i = 0; i < kSamples; ++i) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(i) / period;
    made.row(i) << std::sin(phase), std::cos(1.3 * phase);
  }
  return made;
}

Matrix white(double deviation, std::uint64_t seed) {
  Random random(seed);
  return Matrix::NullaryExpr(kSamples, 2, [&] { return deviation * random.normal(); });
}

/// Noise of an Ornstein-Uhlenbeck process with a memory of some samples.
Matrix coloured(double deviation, double memory, std::uint64_t seed) {
  Matrix noise = white(deviation, seed);
  const double a = std::exp(-1.0 / memory);
  for (Index i = 1; i < kSamples; ++i)
    noise.row(i) = a * noise.row(i - 1) + std::sqrt(1.0 - a * a) * noise.row(i);
  return noise;
}

std::optional<SmoothingFilter> seen(const Matrix& states, const SmoothingOptions& options = {},
                                    const std::vector<Index>& measured = {0, 1}) {
  Dataset data;
  data.states = {{"a", ""}, {"b", ""}};
  Trajectory record;
  record.time = Vector::LinSpaced(states.rows(), 0.0, static_cast<double>(states.rows() - 1));
  record.states = states;
  record.inputs = Matrix(states.rows(), 0);
  data.trajectories = {record};
  return estimated_filter(data, measured, 10.0, options);
}

TEST(SmoothingFilter, MeansAreThoseOfTheSamplesThatTheySay) {
  const Matrix x = white(1.0, 1);
  const Index i = 100;
  const auto mean = [&](Index first, Index count) {
    return x.col(0).segment(first, count).mean();
  };
  EXPECT_NEAR(smoothed({Kind::CentredMean, 5}, x)(i, 0), mean(i - 2, 5), 1e-12);
  EXPECT_NEAR(smoothed({Kind::CentredMean, 4}, x)(i, 0), mean(i - 2, 4), 1e-12);
  EXPECT_NEAR(smoothed({Kind::PastMean, 4}, x)(i, 0), mean(i - 3, 4), 1e-12);
}

TEST(SmoothingFilter, AParabolaStaysAsItIs) {
  Matrix x(60, 1), quartic(60, 1);
  for (Index i = 0; i < 60; ++i) {
    const auto t = static_cast<double>(i);
    x(i, 0) = 3.0 - 2.0 * t + 0.5 * t * t;
    quartic(i, 0) = (t - 30.0) * (t - 30.0) * (t - 30.0) * (t - 30.0);
  }
  const SmoothingFilter filter{Kind::Quadratic, 11};
  EXPECT_NEAR(smoothed(filter, x)(30, 0), x(30, 0), 1e-9);
  // The least-squares parabola of t^4 over -5 ... 5, by the normal equations.
  Eigen::Matrix<double, 11, 3> design;
  Eigen::Matrix<double, 11, 1> fourth;
  for (int j = -5; j <= 5; ++j) {
    design.row(j + 5) << 1.0, j, j * j;
    fourth[j + 5] = std::pow(j, 4);
  }
  const Vector fit = (design.transpose() * design).inverse() * (design.transpose() * fourth);
  EXPECT_NEAR(smoothed(filter, quartic)(30, 0), fit[0], 1e-8);
}

TEST(SmoothingFilter, WhatIsUndoneIsWhatWas) {
  const Matrix x = waves();
  for (const SmoothingFilter& filter : {SmoothingFilter{Kind::CentredMean, 21},
                                        {Kind::CentredMean, 20},
                                        {Kind::PastMean, 21},
                                        {Kind::PastMean, 20},
                                        {Kind::Quadratic, 31}}) {
    const Matrix y = smoothed(filter, x);
    const Index inside = kSamples - 200;
    EXPECT_GT((y - x).middleRows(100, inside).norm(), 1e-3 * x.norm());
    EXPECT_LT((undone(filter, y, kTurns) - x).middleRows(100, inside).norm(), 5e-4 * x.norm())
        << description_of(filter);
  }
}

TEST(SmoothingFilter, NoiseIsNotEnlarged) {
  const Matrix noise = white(1.0, 3);
  for (const SmoothingFilter& filter :
       {SmoothingFilter{Kind::CentredMean, 9}, {Kind::PastMean, 12}, {Kind::Quadratic, 21}}) {
    const Matrix left = undone(filter, smoothed(filter, noise), kTurns);
    EXPECT_LT(left.norm(), noise.norm());
    const Index memory = memory_of(filter), n = kSamples - memory;
    EXPECT_GT(memory, 1);
    EXPECT_LT(memory, 2 * filter.window);
    const double shared =
        left.col(0).head(n).dot(left.col(0).tail(n)) / left.col(0).squaredNorm();
    EXPECT_LT(std::abs(shared), 0.25) << description_of(filter);
  }
}

TEST(SmoothingFilter, NoiseShowsTheFilterThatItWentThrough) {
  for (const SmoothingFilter& filter : {SmoothingFilter{Kind::CentredMean, 3},
                                        {Kind::CentredMean, 8},
                                        {Kind::CentredMean, 25},
                                        {Kind::Quadratic, 7},
                                        {Kind::Quadratic, 21}}) {
    const auto found = seen(smoothed(filter, waves() + white(0.01, 5)));
    ASSERT_TRUE(found.has_value()) << description_of(filter);
    EXPECT_EQ(description_of(*found), description_of(filter));
  }
  const auto past = seen(smoothed({Kind::PastMean, 8}, waves() + white(0.01, 5)));
  ASSERT_TRUE(past.has_value());
  EXPECT_EQ(past->window, 8);
}

TEST(SmoothingFilter, OptionsBoundTheSearchAndTheUndoing) {
  const SmoothingFilter wide{Kind::CentredMean, 25};
  EXPECT_FALSE(seen(smoothed(wide, waves() + white(0.01, 5)), {.widest = 24}).has_value());
  // What is undone further has more of the fast motion, and less of a memory.
  EXPECT_LT(memory_of(wide, {.in_common = 0.3}), memory_of(wide, {.in_common = 0.05}));
  const Matrix fast = waves(50.0), seen_fast = smoothed(wide, fast);
  const auto error = [&](int turns) {
    return (undone(wide, seen_fast, turns) - fast).middleRows(100, kSamples - 200).norm();
  };
  EXPECT_LT(error(60), 0.5 * error(10));
}

TEST(SmoothingFilter, OtherNoiseShowsNone) {
  EXPECT_FALSE(seen(waves() + white(0.01, 7)).has_value());
  EXPECT_FALSE(seen(waves()).has_value()) << "there is no noise";
  for (const double memory : {1.0, 3.0, 10.0, 50.0})
    EXPECT_FALSE(seen(waves() + coloured(0.01, memory, 9)).has_value()) << memory;
  Matrix rounded = waves();
  for (double& value : rounded.reshaped()) value = 0.02 * std::round(value / 0.02);
  EXPECT_FALSE(seen(rounded).has_value());
}

TEST(SmoothingFilter, GaussianWeightsAreNoMeans) {
  constexpr Index kReach = 16;  // of weights with a deviation of 4 samples
  const Matrix x = waves() + white(0.01, 13);
  Matrix sum = Matrix::Zero(x.rows(), x.cols());
  double weights = 0.0;
  for (Index j = -kReach; j <= kReach; ++j) {
    const double weight = std::exp(-0.5 * std::pow(static_cast<double>(j) / 4.0, 2));
    for (Index i = 0; i < x.rows(); ++i)
      sum.row(i) += weight * x.row(std::clamp<Index>(i + j, 0, x.rows() - 1));
    weights += weight;
  }
  EXPECT_FALSE(seen(sum / weights).has_value());
}

TEST(SmoothingFilter, AllStatesHaveToShowIt) {
  Matrix one = waves() + white(0.01, 11);
  one.col(0) = smoothed({Kind::CentredMean, 9}, one).col(0).eval();
  EXPECT_FALSE(seen(one).has_value());
  EXPECT_TRUE(seen(one, {}, {0}).has_value()) << "the other one was not measured";
  EXPECT_FALSE(seen(one, {}, {1}).has_value());
  EXPECT_FALSE(seen(one, {}, {}).has_value());
  EXPECT_FALSE(seen(smoothed({Kind::CentredMean, 9}, one).topRows(200)).has_value())
      << "shorter than a window of the spectrum";
}

/// The driven oscillator's record with its columns smoothed.
support::Asked smoothed_by(const Smoothing& smoothing) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  for (Trajectory& record : data.trajectories) {
    record.states = smoothed(smoothing.filter, record.states);
    if (smoothing.of_inputs) record.inputs = smoothed(smoothing.filter, record.inputs);
  }
  return {.records = observed(data)};
}

TEST(SmoothedRecords, TheModelTellsWhatTheNoiseDoesNotShow) {
  for (const Smoothing& made : {Smoothing{{Kind::CentredMean, 9}},
                                {{Kind::CentredMean, 35}, true},
                                {{Kind::PastMean, 9}},
                                {{Kind::PastMean, 20}},
                                {{Kind::Quadratic, 15}}}) {
    const support::Asked asked = smoothed_by(made);
    const auto found = smoothing_of(asked.problem());
    ASSERT_TRUE(found.has_value()) << note_on(made);
    EXPECT_EQ(note_on(*found), note_on(made));
  }
  EXPECT_FALSE(smoothing_of(support::asked(support::nothing).problem()).has_value());
}

TEST(SmoothedRecords, SamplesThatShareNoiseAndTheEndsAreMissing) {
  const Smoothing smoothing{{Kind::CentredMean, 9}, true};
  const support::Asked asked = smoothed_by(smoothing);
  const BoundRecords sharp = preprocessed(smoothing, asked.records);
  const Trajectory& record = sharp.data.trajectories[0];
  const Index memory = memory_of(smoothing.filter);
  EXPECT_EQ(mark_of(record.marks, 3, 0), Mark::Missing);
  EXPECT_EQ(mark_of(record.marks, 4, 0), Mark::Value);
  EXPECT_EQ(mark_of(record.marks, 5, 0), Mark::Missing);
  EXPECT_EQ(mark_of(record.marks, 4 + memory, 1), Mark::Value);
  EXPECT_EQ(mark_of(record.marks, record.samples() - 4, 1), Mark::Missing);
  EXPECT_EQ(mark_of(sharp.outliers[0], 5, 0), Mark::Missing);
  const Dataset before = support::hidden_record(support::nothing, 0.01);
  const auto error = [&](const Matrix& inputs) {
    const Index n = inputs.rows() - 100;
    return (inputs - before.trajectories[0].inputs).middleRows(50, n).norm();
  };
  EXPECT_LT(error(record.inputs), 0.1 * error(asked.records.data.trajectories[0].inputs));
}

}  // namespace
}  // namespace lacuna
