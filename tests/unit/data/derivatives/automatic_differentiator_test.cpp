// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/automatic_differentiator.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "grids.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/data/derivatives/local_polynomial.hpp"
#include "lacuna/data/derivatives/savitzky_golay.hpp"
#include "lacuna/data/derivatives/smoothing_spline.hpp"

namespace lacuna {
namespace {

Dataset record_with_noise(double noise) {
  Random random(5);
  const Vector time = uniform_grid(400, 12.0);
  Vector y = time.array().sin();
  for (Index i = 0; i < y.size(); ++i) y[i] += noise * random.normal();
  Dataset data;
  data.states = {{"x", ""}};
  data.trajectories.push_back({"", time, y, Matrix(400, 0), Matrix()});
  return data;
}

double error_of(const Stage<Differentiator>& method, const Dataset& data) {
  const Trajectory& record = data.trajectories[0];
  const auto fitted = fitted_to(method, data);
  const Vector rate = fitted->differentiate(record.time, record.states);
  return (rate.array() - record.time.array().cos()).matrix().norm();
}

TEST(AutomaticDifferentiator, IsNearTheBestOfThoseItChoosesFrom) {
  const Dataset data = record_with_noise(0.1);
  double best = error_of(FiniteDifferences{}, data);
  best = std::min(best, error_of(SavitzkyGolay{}, data));
  best = std::min(best, error_of(SmoothingSpline{}, data));
  best = std::min(best, error_of(LocalPolynomial{}, data));
  EXPECT_LT(error_of(AutomaticDifferentiator{}, data), 1.2 * best);
  EXPECT_GT(error_of(FiniteDifferences{}, data), 3.0 * best);
}

// A spline and a path of Kalman's leave noise in a sine that a spectrum does not have: on records
// that are made of them alone each of the two is best.
TEST(AutomaticDifferentiator, JudgesByThePilotsThatSuitTheRecord) {
  const auto fitted =
      fitted_to(Stage<Differentiator>(AutomaticDifferentiator{}), record_with_noise(0.001));
  EXPECT_EQ(fitted->info().name, "spectral");
}

TEST(AutomaticDifferentiator, IsExactWithoutNoise) {
  EXPECT_LT(error_of(AutomaticDifferentiator{}, record_with_noise(0.0)), 1e-4);
}

TEST(AutomaticDifferentiator, TakesDifferencesWhereNothingMoves) {
  Dataset data = record_with_noise(0.0);
  data.trajectories[0].states.setConstant(3.0);
  const auto fitted = fitted_to(Stage<Differentiator>(AutomaticDifferentiator{}), data);
  EXPECT_EQ(fitted->info().name, "finite-differences");
}

TEST(AutomaticDifferentiator, IsTheSameEveryTime) {
  const Dataset data = record_with_noise(0.05);
  EXPECT_EQ(error_of(AutomaticDifferentiator{}, data), error_of(AutomaticDifferentiator{}, data));
}

}  // namespace
}  // namespace lacuna
