// SPDX-License-Identifier: MIT
#include "regression/pruners/elimination.hpp"

#include <gtest/gtest.h>

#include "lacuna/solvers/ols.hpp"
#include "support/sparse_problem.hpp"

namespace lacuna {
namespace {

class EliminationTest : public ::testing::Test {
 protected:
  const LeastSquaresSystem system_ = testing::sparse_problem(200, 0.1, 0.0);
  const Ols ols_ = Ols();
  const RunContext context_ = {};
  const Elimination full_{system_, 0, system_.all_terms(), ols_, context_};
};

TEST_F(EliminationTest, LossesAreWhatTheSquaredResidualGains) {
  const Vector losses = full_.losses();
  ASSERT_GT(full_.size(), 0);
  for (Index i = 0; i < full_.size(); ++i) {
    const Elimination without = full_.without({i});
    const double gain = without.residual_norm() * without.residual_norm() -
                        full_.residual_norm() * full_.residual_norm();
    EXPECT_NEAR(losses[i] * losses[i], gain, 1e-9 * full_.target_norm());
  }
}

TEST_F(EliminationTest, ContributionsAreNormsOfTerms) {
  const Vector contributions = full_.contributions();
  ASSERT_GT(full_.size(), 0);
  for (Index i = 0; i < full_.size(); ++i)
    EXPECT_DOUBLE_EQ(contributions[i],
                     std::abs(full_.coefficients()[i]) * system_.factor().column_norms[i]);
}

TEST_F(EliminationTest, TakesOutSeveralTermsAndLeavesTheOriginal) {
  const Elimination smaller = full_.without({0, 3, 9});
  EXPECT_EQ(smaller.active(), (TermSet{1, 2, 4, 5, 6, 7, 8}));
  EXPECT_EQ(full_.size(), 10);
  const Elimination fresh(system_, 0, smaller.active(), ols_, context_);
  EXPECT_TRUE(smaller.coefficients().isApprox(fresh.coefficients(), 1e-12));
  EXPECT_NEAR(full_.without({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}).residual_norm(),
              full_.target_norm(), 1e-10);
}

}  // namespace
}  // namespace lacuna
