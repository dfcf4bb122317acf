// SPDX-License-Identifier: MIT
#include "lacuna/regression/pruners/keep_all.hpp"

#include <gtest/gtest.h>

#include "lacuna/solvers/ols.hpp"
#include "support/sparse_problem.hpp"

namespace lacuna {
namespace {

TEST(KeepAll, KeepsWhatItIsGiven) {
  const auto system = testing::sparse_problem(50, 0.1, 0.0);
  const PruneResult result = KeepAll().prune(system, 0, {2, 5}, Ols());
  EXPECT_EQ(result.kept, (TermSet{2, 5}));
  EXPECT_TRUE(result.removed.empty());
}

}  // namespace
}  // namespace lacuna
