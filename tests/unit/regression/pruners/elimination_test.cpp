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

/// Of one elimination, and of another one that begins with the terms it has left.
void expect_losses_of_a_fresh_one(const LeastSquaresSystem& system) {
  const Ols ols;
  const RunContext context;
  for (Elimination state(system, 0, system.all_terms(), ols, context); state.size() > 0;
       state = state.without({smallest(state.losses())})) {
    const Vector fresh =
        Elimination(system, 0, state.active(), ols, context).losses();
    EXPECT_LT((state.losses() - fresh).cwiseQuotient(fresh).cwiseAbs().maxCoeff(), 1e-8)
        << state.size();
  }
}

TEST_F(EliminationTest, LossesDoNotDriftWhileTermsLeave) {
  expect_losses_of_a_fresh_one(testing::sparse_problem(200, 0.1, 0.0));
  Matrix theta = Matrix::Random(300, 24);  // near one another, and very near
  for (Index j = 12; j < 24; ++j)
    theta.col(j) = theta.col(j - 12) + (j < 20 ? 1e-2 : 1e-4) * theta.col(j);
  expect_losses_of_a_fresh_one({make_row_source(theta, Matrix::Random(300, 1)),
                                std::vector<std::string>(24), {"y"}});
}

TEST_F(EliminationTest, AnInfiniteLossIsNone) {
  Matrix theta = Matrix::Random(100, 4);
  theta.col(2) = theta.col(1);
  theta.col(3).setZero();
  const LeastSquaresSystem system(make_row_source(theta, Matrix::Random(100, 1)),
                                  std::vector<std::string>(4), {"y"});
  const Elimination state(system, 0, system.all_terms(), ols_, context_);
  EXPECT_GT(state.losses()[0], 0.0);
  EXPECT_EQ(state.losses().tail(3).maxCoeff(), 0.0);
  EXPECT_GT(state.without({2, 3}).losses().minCoeff(), 0.0);
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
