// SPDX-License-Identifier: MIT
#include "identify/validation/predicted_records.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

/// sin t and its derivative, which is not measured.
Dataset sine(double noise) {
  Random random(2);
  constexpr Index kSamples = 2000;
  Dataset data;
  data.states = {{"q", ""}, {"q_d1", ""}};
  data.rate_of = {1, std::nullopt};
  data.reconstructed = {false, true};
  Trajectory record;
  record.time = Vector::LinSpaced(kSamples, 0.0, 40.0);
  record.states.resize(kSamples, 2);
  record.states.col(0) = record.time.array().sin();
  for (Index i = 0; i < kSamples; ++i) record.states(i, 0) += noise * random.normal();
  record.states.col(1).setConstant(50.0);  // what a bad differentiator may have made
  record.inputs.resize(kSamples, 0);
  data.trajectories.push_back(std::move(record));
  return data;
}

TEST(PredictedRecords, PathsAreNearTheTruthWhateverTheDifferentiatorMade) {
  const Dataset data = sine(0.01);
  const PredictedRecords all = predicted_records(data, {{0, 100, 500}}, analyse_noise(data));
  ASSERT_EQ(all.records.size(), 1U);
  const PredictedRecord& record = all.records[0];
  EXPECT_EQ(record.samples.time[0], data.trajectories[0].time[100]);
  const Vector& t = record.samples.time;
  EXPECT_LT((record.path.col(0).array() - t.array().sin()).abs().maxCoeff(), 0.03);
  EXPECT_LT((record.path.col(1).array() - t.array().cos()).abs().maxCoeff(), 0.3);
}

TEST(PredictedRecords, WhatWasNotMeasuredDoesNotCount) {
  const Dataset data = sine(0.01);
  const PredictedRecords all = predicted_records(data, {{0, 0, 300}}, analyse_noise(data));
  EXPECT_TRUE((all.records[0].deviations.col(1).array() == 0.0).all());
  EXPECT_TRUE(all.seen[0]);
  EXPECT_NEAR(all.sigma[0], 0.01, 0.0015);
}

TEST(PredictedRecords, OutliersAndMarkedSamplesDoNotCount) {
  Dataset data = sine(0.01);
  data.trajectories[0].states(120, 0) += 1.0;
  set_mark(data.trajectories[0], 150, 0, Mark::Missing);
  const PredictedRecords all = predicted_records(data, {{0, 100, 300}}, analyse_noise(data));
  const Vector deviations = all.records[0].deviations.col(0);
  EXPECT_EQ(deviations[20], 0.0);
  EXPECT_EQ(deviations[50], 0.0);
  EXPECT_EQ((deviations.array() == 0.0).count(), 2);
}

TEST(PredictedRecords, WithoutNoiseSamplesAreWeighedByWhatTheyMove) {
  const Dataset data = sine(0.0);
  const PredictedRecords all = predicted_records(data, {{0, 0, 300}}, analyse_noise(data));
  EXPECT_FALSE(all.seen[0]);
  // rms of the difference of samples 0.02 apart: 0.02 / sqrt(2).
  EXPECT_NEAR(all.records[0].deviations(0, 0), 1e-4 * 0.02 / std::sqrt(2.0), 2e-8);
}

}  // namespace
}  // namespace lacuna
