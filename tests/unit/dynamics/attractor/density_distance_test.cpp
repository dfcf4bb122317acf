// SPDX-License-Identifier: MIT
#include "dynamics/attractor/density_distance.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

Matrix orbit(const std::string& name, Index first) {
  const TestSystem& system = test_system(name);
  const Dataset record = record_of(system.model, Dopri8{}, system.start, 0.1, first + 10000);
  return record.trajectories[0].states.bottomRows(10000);
}

TEST(DensityDistance, IsZeroForTheSameAndOneForSeparateAttractors) {
  const Matrix states = orbit("rossler", 0);
  EXPECT_NEAR(density_distance(states, states), 0.0, 1e-6);
  EXPECT_EQ(density_distance(states, states.array() + 1000.0), 1.0);
}

TEST(DensityDistance, TellsSystemsApartThatLookAlike) {
  const double chance =
      density_distance(orbit("rossler-adjusted", 1000), orbit("rossler-adjusted", 12000));
  const double systems =
      density_distance(orbit("rossler-adjusted", 1000), orbit("tl072", 1000));
  EXPECT_LT(chance, 0.2);
  EXPECT_GT(systems, 2.0 * chance);
}

TEST(DensityDistance, UnitsDoNotCount) {
  Matrix a = orbit("rossler", 500), b = orbit("rossler", 9000);
  const double before = density_distance(a, b);
  a.col(2) *= 8.0;
  b.col(2) *= 8.0;
  EXPECT_NEAR(density_distance(a, b), before, 1e-12);
}

}  // namespace
}  // namespace lacuna
