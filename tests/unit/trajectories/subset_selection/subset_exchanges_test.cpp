// SPDX-License-Identifier: MIT
#include "trajectories/subset_selection/subset_exchanges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/random.hpp"
#include "support/correlated_rows.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
