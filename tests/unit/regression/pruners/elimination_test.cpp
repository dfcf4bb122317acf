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

}  // namespace
}  // namespace lacuna
