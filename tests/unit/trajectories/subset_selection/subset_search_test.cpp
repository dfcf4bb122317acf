// SPDX-License-Identifier: MIT
#include "trajectories/subset_selection/subset_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"
#include "support/correlated_rows.hpp"

namespace lacuna {
namespace {

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

TEST(SubsetSearch, HonoursAStopRequest) {
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  const SubsetProblem problem = subset_problem(triangle_of(correlated_rows(1.0)));
  EXPECT_THROW(best_subset(problem, 12.0, {}, Exchange::Pairs, context), Cancelled);
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
