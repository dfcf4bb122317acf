// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/test_systems/measurement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

Dataset lorenz_record(Index n) {
  const TestSystem& system = test_system("lorenz");
  return record_of(system.model, Dopri8{}, system.start, system.step, n);
}

TEST(RecordOf, BringsStatesAndDerivatives) {
  const Dataset record = lorenz_record(2000);
  ASSERT_NO_THROW(check_dataset(record));
  ASSERT_TRUE(record.has_derivatives());
  const Trajectory& run = record.trajectories[0];
  EXPECT_EQ(run.samples(), 2000);
  EXPECT_EQ(run.states(0, 2), 27.0);
  for (Index i = 0; i < 2000; i += 97) {
    const double x = run.states(i, 0), y = run.states(i, 1), z = run.states(i, 2);
    EXPECT_NEAR(run.derivatives(i, 0), 10.0 * (y - x), 1e-11);
    EXPECT_NEAR(run.derivatives(i, 2), x * y - 8.0 / 3.0 * z, 1e-11);
  }
}

TEST(RecordOf, DivergenceIsAnError) {
  const TestSystem& system = test_system("rossler");
  EXPECT_THROW(record_of(system.model, Rk4{}, Vector{{500.0, 0.0, 500.0}}, 0.5, 1000),
               ArgumentError);
}

TEST(AddNoise, HasTheGivenDeviationPerState) {
  const Dataset clean = lorenz_record(20000);
  const Dataset noisy = add_noise(clean, Vector{{0.1, 0.0, 2.0}}, 7);
  const Matrix noise = noisy.trajectories[0].states - clean.trajectories[0].states;
  EXPECT_NEAR(noise.col(0).norm() / std::sqrt(20000.0), 0.1, 0.002);
  EXPECT_EQ(noise.col(1).norm(), 0.0);
  EXPECT_NEAR(noise.col(2).norm() / std::sqrt(20000.0), 2.0, 0.04);
  EXPECT_NEAR(noise.col(2).mean(), 0.0, 0.06);
  EXPECT_FALSE(noisy.has_derivatives());
}

TEST(AddNoise, SeedDecides) {
  const Dataset clean = lorenz_record(100);
  const Vector sigma = Vector::Ones(3);
  const Matrix first = add_noise(clean, sigma, 1).trajectories[0].states;
  EXPECT_EQ(first, add_noise(clean, sigma, 1).trajectories[0].states);
  EXPECT_NE(first, add_noise(clean, sigma, 2).trajectories[0].states);
}

TEST(AddNoise, RelativeNoiseFollowsTheSpread) {
  const Dataset clean = lorenz_record(20000);
  const Matrix& states = clean.trajectories[0].states;
  const Matrix noise = add_relative_noise(clean, 0.01, 5).trajectories[0].states - states;
  for (Index k = 0; k < 3; ++k) {
    const double spread = (states.col(k).array() - states.col(k).mean()).matrix().norm();
    EXPECT_NEAR(noise.col(k).norm() / spread, 0.01, 0.0003);
  }
}

TEST(Quantise, GivesTheNearestLevel) {
  Dataset record;
  record.states = {{"x", "V"}};
  const Vector values{{0.0, 0.3, 0.874, -0.9, -1.2, 3.0}};
  record.trajectories = {{"", Vector::LinSpaced(6, 0.0, 5.0), values, Matrix(6, 0), Matrix()}};
  const Dataset digital = quantise(record, 3, 1.0);
  const Vector expected{{0.0, 0.25, 0.75, -1.0, -1.0, 0.75}};
  EXPECT_EQ(digital.trajectories[0].states, Matrix(expected));
}

TEST(Quantise, ErrorIsAtMostHalfALevel) {
  const Dataset clean = lorenz_record(1000);
  const Matrix digital = quantise(clean, 16, 64.0).trajectories[0].states;
  EXPECT_LE((digital - clean.trajectories[0].states).cwiseAbs().maxCoeff(), 64.0 / 65536.0);
}

}  // namespace
}  // namespace lacuna
