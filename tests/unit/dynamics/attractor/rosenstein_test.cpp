// SPDX-License-Identifier: MIT
#include "dynamics/attractor/rosenstein.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

Divergence divergence_of(const std::string& name, double h, Index n) {
  const TestSystem& system = test_system(name);
  const Dataset record = record_of(system.model, Dopri8{}, system.start, h, n);
  return rosenstein_divergence(record.trajectories[0], 500);
}

TEST(RosensteinDivergence, FindsTheKnownExponents) {
  EXPECT_NEAR(divergence_of("lorenz", 0.02, 8000).exponent, 0.906, 0.15);
  EXPECT_NEAR(divergence_of("rossler", 0.1, 20000).exponent, 0.0714, 0.02);
}

TEST(RosensteinDivergence, ALimitCycleHasNone) {
  EXPECT_NEAR(divergence_of("van-der-pol", 0.05, 6000).exponent, 0.0, 0.02);
}

TEST(RosensteinDivergence, MeanPeriodOfASineIsItsPeriod) {
  Trajectory sine;
  sine.time = Vector::LinSpaced(2001, 0.0, 100.0);
  sine.states.resize(2001, 1);
  sine.states.col(0) = (2.0 * std::numbers::pi / 3.0 * sine.time).array().sin();
  EXPECT_NEAR(rosenstein_divergence(sine, 50).mean_period, 3.0, 0.02);
}

TEST(RosensteinDivergence, UnitsOfTheStatesDoNotCount) {
  const TestSystem& system = test_system("lorenz");
  Dataset record = record_of(system.model, Dopri8{}, system.start, 0.02, 4000);
  const double before = rosenstein_divergence(record.trajectories[0], 200).exponent;
  record.trajectories[0].states.col(1) *= 1000.0;
  EXPECT_NEAR(rosenstein_divergence(record.trajectories[0], 200).exponent, before, 1e-9);
}

}  // namespace
}  // namespace lacuna
