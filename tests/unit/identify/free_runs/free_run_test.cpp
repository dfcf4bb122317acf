// SPDX-License-Identifier: MIT
#include "identify/free_runs/free_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "identify/free_runs/averaged_records.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

/// dx/dt = -x + u, u held for 25 samples each, solved exactly; noise of the samples with a
/// correlation from each to the next.
Dataset record_of(double noise, double correlation, std::uint64_t seed) {
  constexpr Index kSamples = 1500;
  constexpr double kStep = 0.05;
  Random random(seed);
  Trajectory record;
  record.time = Vector::LinSpaced(kSamples, 0.0, kStep * (kSamples - 1));
  record.states.resize(kSamples, 1);
  record.inputs.resize(kSamples, 1);
  double x = 0.0, u = 0.0, error = random.normal();
  for (Index i = 0; i < kSamples; ++i) {
    if (i % 25 == 0) u = random.normal();
    record.states(i, 0) = x + noise * error;
    record.inputs(i, 0) = u;
    x = u + (x - u) * std::exp(-kStep);
    error = correlation * error + std::sqrt(1.0 - correlation * correlation) * random.normal();
  }
  return support::one_record({{"x", ""}}, {{"u", "", Hold::Zero}}, record);
}

SystemModel model_of(const std::string& equation) {
  return SystemModel(parse_ode("input u hold zero\n" + equation + "\n", "made"));
}

TEST(FreeRun, FitsTheCoefficientsAndCountsWhiteResidualsInFull) {
  const FreeRun run =
      free_run(model_of("dx/dt = -0.8*x + 1.3*u"), record_of(0.02, 0.0, 3), {}, {});
  EXPECT_NEAR(run.system.symbolic().coefficient(0, "x"), -1.0, 0.01);
  EXPECT_NEAR(run.system.symbolic().coefficient(0, "u"), 1.0, 0.01);
  EXPECT_EQ(run.numbers, 2u);
  EXPECT_GT(run.independent, 0.85);
  // Of n normal values of deviation s: n (ln(2 pi s^2) + 1).
  EXPECT_NEAR(run.deviance, 1500.0 * (std::log(2.0 * M_PI * 0.02 * 0.02) + 1.0), 150.0);
}

TEST(FreeRun, CorrelatedResidualsCountAsFewSamples) {
  const FreeRun run = free_run(model_of("dx/dt = -x + u"), record_of(0.02, 0.8, 4), {}, {});
  EXPECT_NEAR(run.independent, 0.2 / 1.8, 0.03);
}

TEST(FreeRun, ATermHasToBeWorthIt) {
  const Dataset data = record_of(0.02, 0.0, 5);
  const FreeRun whole = free_run(model_of("dx/dt = -x + u"), data, {}, {});
  const FreeRun more = free_run(model_of("dx/dt = -x + u + 0.01*x^2"), data, {}, {});
  const FreeRun fewer = free_run(model_of("dx/dt = u"), data, {}, {});
  EXPECT_FALSE(is_worth(more, whole));
  EXPECT_TRUE(is_worth(whole, fewer));
  EXPECT_TRUE(is_better(whole, more));
  EXPECT_TRUE(is_better(whole, fewer));
  EXPECT_FALSE(is_better(fewer, whole));
}

TEST(FreeRun, ALeastFractionIsAskedOfEachNumber) {
  FreeRun fewer{model_of("dx/dt = u"), 0.0, 1.0, 1, 1000.0};
  FreeRun more = fewer;
  more.numbers = 2;
  more.deviance = 2.0 * 1000.0 * std::log(0.85);  // 15 % off the residuals
  EXPECT_TRUE(is_worth(more, fewer));
  EXPECT_TRUE(is_worth(more, fewer, 0.14));
  EXPECT_FALSE(is_worth(more, fewer, 0.16));
}

TEST(FreeRun, AModelThatRunsAwayIsWorthNothing) {
  const FreeRun away =
      free_run(model_of("dx/dt = 900*x^3 + u"), record_of(0.02, 0.0, 6), {}, {});
  const FreeRun fine = free_run(model_of("dx/dt = -x + u"), record_of(0.02, 0.0, 6), {}, {});
  EXPECT_TRUE(is_better(fine, away));
}

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
