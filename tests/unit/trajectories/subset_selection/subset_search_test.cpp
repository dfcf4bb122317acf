// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/correlated_rows.hpp"
#include "trajectories/subset_selection/subset_exchanges.hpp"
#include "trajectories/subset_selection/subset_problem.hpp"
#include "trajectories/subset_selection/subset_search.hpp"

namespace lacuna {
namespace {

TEST(SubsetProblem, LossIsTheGainOfTakingItBack) {
  const SubsetProblem problem = subset_problem(triangle_of(correlated_rows(1.0)));
  const Vector losses = losses_of(fit_subset(problem, {1, 4, 9}));
  EXPECT_NEAR(losses[1], gains_of(problem, {1, 9})[4], 1e-6 * losses[1]);
  EXPECT_NEAR(losses[1],
              fit_subset(problem, {1, 9}).residual - fit_subset(problem, {1, 4, 9}).residual,
              1e-6 * losses[1]);
}

TEST(SubsetProblem, VarianceIsThatOfLeastSquares) {
  const Matrix rows = correlated_rows(1.0);
  Matrix chosen(400, 2);
  chosen << rows.col(1), rows.col(4);
  const Matrix expected = (chosen.transpose() * chosen).inverse();
  const Vector variances = variances_of(subset_problem(triangle_of(rows)), {1, 4});
  EXPECT_NEAR(variances[0], expected(0, 0), 1e-9 * expected(0, 0));
}

TEST(SubsetProblem, CoefficientsAreThoseOfTheRows) {
  const Matrix rows = correlated_rows(1.0);
  Matrix chosen(400, 2);
  chosen << rows.col(9), rows.col(4);
  const Vector expected = chosen.colPivHouseholderQr().solve(rows.col(12));
  const SubsetProblem problem = subset_problem(triangle_of(rows));
  EXPECT_TRUE(solution_of(problem, {9, 4}).isApprox(expected, 1e-9));
  const double left = (rows.col(12) - chosen * expected).squaredNorm();
  EXPECT_NEAR(fit_subset(problem, {9, 4}).residual, left, 1e-9 * left);
}

/// Sum of squares of a subset with one column more.
double with(const SubsetProblem& problem, std::vector<Index> subset, Index column) {
  subset.push_back(column);
  std::sort(subset.begin(), subset.end());
  return fit_subset(problem, subset).residual;
}

/// A problem in which columns depend on those before them, so that little of some is new.
SubsetProblem dependent_columns(std::uint64_t seed) {
  Random random(seed);
  Matrix rows(60, 9);
  for (double& entry : rows.reshaped()) entry = random.normal();
  for (Index j = 1; j < 8; ++j) rows.col(j) += random.uniform(0.0, 4.0) * rows.col(j - 1);
  rows.col(8) += rows.col(0) - 0.7 * rows.col(3) + 0.4 * rows.col(6);
  return subset_problem(triangle_of(rows));
}

std::vector<Index> without(const std::vector<Index>& subset, std::size_t i, std::size_t j) {
  std::vector<Index> rest;
  for (std::size_t k = 0; k < subset.size(); ++k)
    if (k != i && k != j) rest.push_back(subset[k]);
  return rest;
}

TEST(SubsetExchanges, TheReplacementIsTheColumnThatLeavesLeast) {
  const std::vector<Index> subset{1, 4, 6};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SubsetProblem problem = dependent_columns(seed);
    const SubsetExchanges exchanges = exchanges_of(problem, subset);
    ASSERT_FALSE(subset.empty());
    for (std::size_t i = 0; i < subset.size(); ++i)
      for (std::size_t j = i; j < subset.size(); ++j) {
        const std::vector<Index> rest = without(subset, i, j);
        double least = 1e300;
        Index best = -1;
        for (Index c = 0; c < problem.columns(); ++c) {
          if (std::find(subset.begin(), subset.end(), c) != subset.end()) continue;
          const double left = with(problem, rest, c);
          if (left < least) best = c;
          least = std::min(least, left);
        }
        const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
        EXPECT_EQ(replacement(exchanges, a, b, 1.001 * least), best) << seed << " " << i << j;
        EXPECT_EQ(replacement(exchanges, a, b, 0.999 * least), std::nullopt);
      }
  }
}

TEST(SubsetSearch, DependentAndEmptyColumnsAreNotAdded) {
  Matrix rows = correlated_rows(0.1);
  rows.col(2) = rows.col(1) - 2.0 * rows.col(4);
  rows.col(3).setZero();
  const SubsetProblem problem = subset_problem(triangle_of(rows));
  const Subset found = best_subset(problem, 12.0, {}, Exchange::Pairs);
  EXPECT_LE(found.columns.size(), 3U);
  EXPECT_TRUE(solution_of(problem, found.columns).allFinite());
  EXPECT_EQ(gains_of(problem, {1, 4})[3], 0.0);
}

/// Score of the best of all subsets of so few columns.
double best_of_all(const SubsetProblem& problem, double penalty) {
  double best = fit_subset(problem, {}).residual;
  for (unsigned mask = 1; mask < (1U << problem.columns()); ++mask) {
    std::vector<Index> subset;
    for (Index j = 0; j < problem.columns(); ++j)
      if (mask >> j & 1U) subset.push_back(j);
    best = std::min(best, fit_subset(problem, subset).residual +
                              penalty * static_cast<double>(subset.size()));
  }
  return best;
}

TEST(SubsetSearch, IsTheBestOfAllSubsets) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    Matrix rows(60, 9);
    for (double& entry : rows.reshaped()) entry = random.normal();
    rows.col(1) += 3.0 * rows.col(0);
    rows.col(2) += 3.0 * rows.col(1);
    rows.col(8) += rows.col(2) + 0.7 * rows.col(3) - 0.4 * rows.col(5);
    const SubsetProblem problem = subset_problem(triangle_of(rows));
    EXPECT_NEAR(best_subset(problem, 6.0, {}, Exchange::Pairs).score, best_of_all(problem, 6.0),
                1e-6)
        << trial;
  }
}

TEST(SubsetSearch, ColumnsOnTheVergeOfDependenceComeToAnEnd) {
  Matrix rows = correlated_rows(1.0);
  Random random(4);
  for (Index j = 0; j < 6; ++j)
    for (Index i = 0; i < rows.rows(); ++i)
      rows(i, 2 * j + 1) = rows(i, 2 * j) + 1e-8 * random.normal();
  rows.col(12) *= 1e6;
  const SubsetProblem problem = subset_problem(triangle_of(rows));
  const Subset found =
      best_subset(problem, 12.0, {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}, Exchange::Pairs);
  EXPECT_LE(found.score, fit_subset(problem, {}).residual);
}

TEST(SubsetSearch, WithoutColumnsNoneIsChosen) {
  const SubsetProblem problem = subset_problem(Matrix::Constant(1, 1, 3.0));
  for (const Exchange exchange : {Exchange::Single, Exchange::Pairs}) {
    const Subset found = best_subset(problem, 12.0, {{}}, exchange);
    EXPECT_TRUE(found.columns.empty());
    EXPECT_DOUBLE_EQ(found.score, 9.0) << "all of the target";
  }
}

}  // namespace
}  // namespace lacuna
