// SPDX-License-Identifier: MIT
#include "solvers/subset_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "unit/solvers/random_rows.hpp"

namespace lacuna {
namespace {

TEST(SubproblemFit, GainsAreWhatARefitSaves) {
  Random random(3);
  const auto data = testing::random_rows(60, 7, 3, 0.5, random);
  const LeastSquaresSystem system = data.system();
  const TermSet set{1, 5};
  const SubproblemFit fit = fit_subset(system.subproblem(0, system.all_terms()), set);
  EXPECT_NEAR(fit.residual, data.residual({1, 5}), 1e-10);
  for (Index j = 0; j < 7; ++j) {
    const bool member = j == 1 || j == 5;
    const double with = data.residual({1, 5, j});
    const double saved = member ? 0.0 : fit.residual * fit.residual - with * with;
    EXPECT_NEAR(fit.gains[j], saved, 1e-8) << j;
  }
}

TEST(SubproblemFit, ADependentColumnGainsNothing) {
  Random random(3);
  auto data = testing::random_rows(60, 4, 3, 0.5, random);
  data.theta.col(3) = data.theta.col(0) + 2.0 * data.theta.col(1);
  const LeastSquaresSystem system = data.system();
  const SubproblemFit fit = fit_subset(system.subproblem(0, system.all_terms()), {0, 1});
  EXPECT_EQ(fit.gains[3], 0.0);
  EXPECT_NEAR(fit.residual, data.residual({0, 1}), 1e-10);
}

TEST(SubsetScore, IsThatOfSchwarz) {
  Random random(3);
  const auto data = testing::random_rows(50, 3, 2, 0.5, random);
  const LeastSquaresSystem system = data.system();
  const Subproblem problem = system.subproblem(0, system.all_terms());
  const SubsetScore score(problem, 1.5);
  const double y = data.y.norm();
  EXPECT_NEAR(score(0.1 * y, 3), 100.0 * std::log(0.1) + 4.5 * std::log(50.0), 1e-9);
  EXPECT_EQ(score(1e-14 * y, 3), score(1e-13 * y, 3));
  const double r = 0.4 * y, gain = score.least_gain(r);
  EXPECT_NEAR(score(std::sqrt(r * r - gain), 4), score(r, 3), 1e-9);
}

TEST(RidgeSolution, SolvesTheNormalEquations) {
  Random random(8);
  const auto data = testing::random_rows(20, 4, 2, 0.5, random);
  Vector penalty(4);
  penalty << 0.0, 0.1, 1.0, 10.0;
  Matrix normal = data.theta.transpose() * data.theta;
  normal.diagonal() += penalty;
  const Vector expected = normal.inverse() * (data.theta.transpose() * data.y);
  EXPECT_TRUE(ridge_solution(data.theta, data.y, penalty).isApprox(expected, 1e-10));
}

}  // namespace
}  // namespace lacuna
