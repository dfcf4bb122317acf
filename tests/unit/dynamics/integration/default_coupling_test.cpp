// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>

#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

Dataset harmonic(double frequency, double h, Index n) {
  Dataset record;
  record.states = {{"x", ""}, {"y", ""}};
  const Vector time = sample_times(0.0, h, n);
  Matrix states(n, 2);
  states.col(0) = (frequency * time.array()).sin();
  states.col(1) = 1e-3 * (frequency * time.array()).cos() + 7.0;
  record.trajectories = {{"", time, states, Matrix(n, 0), Matrix()}};
  return record;
}

double strength(const Dataset& record) { return default_coupling(record)(0, 0); }

TEST(DefaultCoupling, IsTheFrequencyOfAnOscillation) {
  EXPECT_NEAR(strength(harmonic(3.0, 0.01, 5000)), 3.0, 0.03);
  EXPECT_NEAR(strength(harmonic(3e4, 1e-6, 5000)), 3e4, 300.0);
  EXPECT_NEAR(strength(harmonic(3.0, 0.15, 5000)), 3.0, 0.15);
}

TEST(DefaultCoupling, DoesNotGrowWithNoiseOrSampling) {
  const Dataset dense = harmonic(3.0, 0.001, 50000);
  EXPECT_NEAR(strength(add_relative_noise(dense, 0.05, 3)), 3.0, 0.15);
}

TEST(DefaultCoupling, ConstantRecordHasItsLengthOnly) {
  Dataset record = harmonic(3.0, 0.1, 101);
  record.trajectories[0].states.setConstant(1.0);
  EXPECT_NEAR(strength(record), 0.1, 1e-12);
}

TEST(DefaultCoupling, IgnoresStatesThatDoNotMove) {
  Dataset record = harmonic(3.0, 0.01, 5000);
  record.trajectories[0].states.col(1).setZero();
  EXPECT_NEAR(strength(record), 3.0, 0.03);
}

// The slave starts one deviation off and must have forgotten it.
class StrongEnough : public testing::TestWithParam<const char*> {};

TEST_P(StrongEnough, ToSynchronise) {
  const TestSystem& system = test_system(GetParam());
  const Dataset record =
      record_of(system.model, Dopri8({.substeps = 2}), system.start, system.step, 4000);
  const Matrix& states = record.trajectories[0].states;
  const Vector start = 0.5 * (states.row(0) + states.colwise().mean()).transpose();
  const SyncResult result = synchronise(system.model, record, Rk4{}, {{}, start});
  EXPECT_TRUE(result.settled) << result.coupling(0, 0) << " " << result.relative;
  EXPECT_LT(result.errors[0].tail(1000).maxCoeff(), 0.01 * states.rowwise().norm().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Systems, StrongEnough,
                         testing::Values("rossler", "lorenz", "tl072", "pendulum", "chua",
                                         "duffing", "fitzhugh-nagumo", "memristor",
                                         "rossler-adjusted", "van-der-pol"));

/// A context whose deadline comes when the given activity is reported for the n-th time.
void end_at(RunContext& context, const std::string& activity, int n) {
  context.progress = [&context, activity, left = n](const Progress& progress) mutable {
    if (progress.activity == activity && --left == 0)
      context.deadline = std::chrono::steady_clock::now();
  };
}

TEST(Synchroniser, PastTheDeadlineTheSlavesStayAndTheRestIsLeftOut) {
  const TestSystem& system = test_system("rossler");
  const Dataset record = record_of(system.model, Dopri8{}, system.start, 0.1, 500);
  const Vector noise = Vector::Constant(3, 0.01);
  RunContext context;
  end_at(context, "synchronising", 2);  // the second slave shows the response to noise
  const SyncResult cut = synchronise(system.model, record, Rk4{}, {.noise = noise}, context);
  const SyncResult whole = synchronise(system.model, record, Rk4{}, {.noise = noise});
  EXPECT_EQ(cut.median, whole.median);
  EXPECT_EQ(cut.response, Vector::Zero(3));
  EXPECT_GT(whole.response.maxCoeff(), 0.0);
  EXPECT_EQ(cut.stages.front().name, "slaves");
  EXPECT_TRUE(cut.stages.front().done);
  EXPECT_NE(left_out_line(cut.stages), "");
  EXPECT_EQ(left_out_line(whole.stages), "");
  RunContext at_once;
  end_at(at_once, "synchronising", 1);
  EXPECT_THROW(synchronise(system.model, record, Rk4{}, {.noise = noise}, at_once), OutOfTime);
}

}  // namespace
}  // namespace lacuna
