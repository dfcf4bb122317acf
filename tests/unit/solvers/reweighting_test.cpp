// SPDX-License-Identifier: MIT
#include "solvers/reweighting.hpp"

#include <gtest/gtest.h>

#include "support/sparse_problem.hpp"

namespace lacuna {
namespace {

ReweightingOutcome plain(const LeastSquaresSystem& system, const ReweightingRule& rule) {
  const auto solve = [](const Subproblem& weighted, const Vector&, const WeightFunction&) {
    return weighted.solve();
  };
  return reweight(system, system.subproblem(0, system.all_terms()), rule, solve, {});
}

/// Sum of the Huber function of the residuals.
double huber(const LeastSquaresSystem& system, const Vector& h, double delta) {
  double sum = 0.0;
  for (const double r : system.residuals(0, system.all_terms(), h)) {
    const double size = std::abs(r);
    sum += size <= delta ? 0.5 * r * r / delta : size - 0.5 * delta;
  }
  return sum;
}

TEST(Reweighting, MinimisesTheHuberFunctionOfARawDelta) {
  const auto system = testing::sparse_problem(500, 0.1, 0.1);
  const double delta = 0.05;
  const ReweightingOutcome found = plain(system, {false, delta, 1e-12, 1000});
  EXPECT_TRUE(found.converged);
  const double best = huber(system, found.coefficients, delta);
  for (Index j = 0; j < 10; ++j) {
    for (const double step : {-1e-4, 1e-4}) {
      Vector moved = found.coefficients;
      moved[j] += step;
      EXPECT_GT(huber(system, moved, delta), best);
    }
  }
}

}  // namespace
}  // namespace lacuna
