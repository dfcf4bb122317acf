// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/regression/stages/solvers.hpp"
#include "solvers/ols.hpp"
#include "support/stage_invariance.hpp"

namespace lacuna::testing {

/// The pruner with least squares finds exactly Rossler's seven terms on these derivatives.
inline void expect_rossler_terms(const TermPruner& pruner, const Matrix& derivatives,
                                 int degree, const Rewriting& r = {"same"}) {
  SCOPED_TRACE(r.name + ", degree " + std::to_string(degree));
  const auto system = rewritten(rossler_10000().states, derivatives, degree, r);
  for (Index k = 0; k < 3; ++k) {
    const PruneResult result =
        pruner.prune(system, new_target(k, r), system.all_terms(), Ols());
    EXPECT_THAT(
        old_names(system, result.kept, r),
        ::testing::UnorderedElementsAreArray(rossler_terms()[static_cast<std::size_t>(k)]));
  }
}

/// Cases without a sensible model end with a result.
inline void expect_survives_odd_problems(const TermPruner& pruner) {
  Matrix theta = Matrix::Ones(6, 3);
  theta.col(1).setLinSpaced(0.0, 1.0);
  Matrix targets = Matrix::Zero(6, 2);
  targets.col(1).setLinSpaced(0.0, 3.0);
  const LeastSquaresSystem system(make_row_source(theta, targets), {"1", "t", "1 again"},
                                  {"zero", "t"});
  EXPECT_TRUE(pruner.prune(system, 0, {}, Ols()).kept.empty());
  EXPECT_TRUE(pruner.prune(system, 0, system.all_terms(), Ols()).kept.empty());
  EXPECT_EQ(pruner.prune(system, 1, {1}, Ols()).kept, (TermSet{1}));
  EXPECT_THAT(pruner.prune(system, 1, system.all_terms(), Ols()).kept,
              ::testing::Contains(Index{1}));
}

}  // namespace lacuna::testing
