// SPDX-License-Identifier: MIT
#include "identify/free_runs/free_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/model/files/ode_text.hpp"

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
  Dataset data;
  data.states = {{"x", ""}};
  data.inputs = {{"u", "", Hold::Zero}};
  data.trajectories = {record};
  return data;
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

}  // namespace
}  // namespace lacuna
