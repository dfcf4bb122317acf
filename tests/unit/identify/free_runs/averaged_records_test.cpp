// SPDX-License-Identifier: MIT
#include "identify/free_runs/averaged_records.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

/// x = t^3 - 2 t with its derivative as a state that was made of it, and an input 3 t, held.
Dataset cubic(double step) {
  constexpr Index kSamples = 200;
  Trajectory record;
  record.time = Vector::LinSpaced(kSamples, 0.0, step * (kSamples - 1));
  record.states.resize(kSamples, 2);
  record.states.col(0) = record.time.array().cube() - 2.0 * record.time.array();
  record.states.col(1).setConstant(1e6);  // nothing of it is used
  record.inputs = 3.0 * record.time;
  Dataset data;
  data.states = {{"x", ""}, {"x_d1", ""}};
  data.inputs = {{"u", "", Hold::Zero}};
  data.rate_of = {1, std::nullopt};
  data.reconstructed = {false, true};
  data.trajectories = {record};
  return data;
}

TEST(AveragedRecords, DerivativesAreExactForPolynomials) {
  constexpr double kStep = 0.01;
  for (const Index half : {2, 7, 20}) {
    const Dataset means = averaged(cubic(kStep), half);
    const Trajectory& record = means.trajectories.at(0);
    ASSERT_GT(record.samples(), 5);
    for (Index i = 0; i < record.samples(); ++i) {
      const double t = record.time[i];
      // The mean of t^3 about t is t^3 + 3 t times the second moment of the window.
      const double moment = (record.states(i, 0) - (t * t * t - 2.0 * t)) / (3.0 * t);
      EXPECT_GT(moment, 0.0);
      EXPECT_LT(moment, std::pow(kStep * static_cast<double>(half), 2));
      EXPECT_NEAR(record.derivatives(i, 1), 6.0 * t, 1e-7) << half;
      EXPECT_NEAR(record.derivatives(i, 0), record.states(i, 1), 1e-10) << half;
      const double reach = kStep * static_cast<double>(half);
      EXPECT_NEAR(record.states(i, 1), 3.0 * t * t - 2.0, 3.1 * reach * reach);
    }
  }
}

TEST(AveragedRecords, AHeldInputCountsFromItsSampleOn) {
  const Trajectory record = averaged(cubic(0.01), 4).trajectories.at(0);
  ASSERT_GT(record.samples(), 5);
  for (Index i = 1; i < record.samples(); ++i)  // nobody knows what was before the first sample
    EXPECT_NEAR(record.inputs(i, 0), 3.0 * (record.time[i] - 0.005), 1e-12);
}

TEST(AveragedRecords, ShortRecordsAreLeftOut) {
  EXPECT_TRUE(averaged(cubic(0.01), 60).trajectories.empty());
}

/// A logger whose clock is late by up to a third of a step.
TEST(AveragedRecords, UnevenStepsCountAsEvenOnes) {
  Dataset data = cubic(0.01);
  Trajectory& record = data.trajectories[0];
  for (Index i = 1; i < record.samples(); ++i)
    record.time[i] += 0.003 * std::sin(static_cast<double>(i * i));
  record.states.col(0) = record.time.array().cube() - 2.0 * record.time.array();
  const Trajectory means = averaged(data, 7).trajectories.at(0);
  ASSERT_GT(means.samples(), 5);
  for (Index i = 0; i < means.samples(); ++i)
    EXPECT_NEAR(means.derivatives(i, 1), 6.0 * means.time[i], 1e-7);
}

}  // namespace
}  // namespace lacuna
