// SPDX-License-Identifier: MIT
#include "lacuna/regression/linear/subproblem.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "lacuna/core/base/error.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/linear/row_source.hpp"

namespace lacuna {
namespace {

std::vector<std::string> numbered(const std::string& prefix, Index count) {
  std::vector<std::string> names;
  for (Index i = 0; i < count; ++i) names.push_back(prefix + std::to_string(i));
  return names;
}

LeastSquaresSystem system_of(const Matrix& theta, const Matrix& targets,
                             Folding folding = Folding::Automatic) {
  return LeastSquaresSystem(make_row_source(theta, targets), numbered("t", theta.cols()),
                            numbered("y", targets.cols()), {}, folding);
}

Vector reference_solution(const Matrix& theta, const Vector& target) {
  return theta.colPivHouseholderQr().solve(target);
}

class SubproblemFoldings : public ::testing::TestWithParam<Folding> {
 protected:
  const Matrix theta_ = Matrix::Random(400, 8) * Vector::LinSpaced(8, 0.1, 50.0).asDiagonal();
  const Matrix targets_ = Matrix::Random(400, 3);
  const LeastSquaresSystem system_ = system_of(theta_, targets_, GetParam());
};

TEST_P(SubproblemFoldings, SolvesSubsetsLikeAPivotedDecomposition) {
  for (const TermSet& active : {TermSet{0, 1, 2, 3, 4, 5, 6, 7}, TermSet{0, 1, 2}, TermSet{7},
                                TermSet{1, 4, 6}, TermSet{5, 6, 7}}) {
    for (Index target = 0; target < 3; ++target) {
      const Subproblem problem = system_.subproblem(target, active);
      const Matrix columns = theta_(Eigen::all, active);
      const Vector expected = reference_solution(columns, targets_.col(target));
      EXPECT_LT((problem.solve() - expected).norm(), 1e-12 * expected.norm());
      EXPECT_NEAR(problem.residual_norm(), (targets_.col(target) - columns * expected).norm(),
                  1e-11);
      EXPECT_NEAR(problem.target_norm(), targets_.col(target).norm(), 1e-12);
    }
  }
}

TEST_P(SubproblemFoldings, ResidualNormOfAnyCoefficients) {
  const TermSet active{1, 2, 5};
  const Vector h = Vector::Random(3);
  const double expected = (targets_.col(2) - theta_(Eigen::all, active) * h).norm();
  EXPECT_NEAR(system_.subproblem(2, active).residual_norm(h), expected, 1e-11 * expected);
}

TEST_P(SubproblemFoldings, EliminationEqualsRefitting) {
  Subproblem problem = system_.subproblem(1, system_.all_terms());
  for (const Index position : {3, 0, 5, 2, 2, 1}) {
    problem.remove(position);
    const Subproblem refit = system_.subproblem(1, problem.active());
    EXPECT_LT((problem.solve() - refit.solve()).norm(), 1e-12 * refit.solve().norm());
    EXPECT_NEAR(problem.residual_norm(), refit.residual_norm(), 1e-11);
    EXPECT_EQ(problem.column_norms(), refit.column_norms());
  }
  EXPECT_EQ(problem.size(), 2);
}

TEST_P(SubproblemFoldings, SolvesNormalEquations) {
  const TermSet active{0, 3, 7};
  const Matrix columns = theta_(Eigen::all, active);
  const Vector gradient = Vector::Random(3);
  const Vector expected = (columns.transpose() * columns).ldlt().solve(gradient);
  const Vector found = system_.subproblem(0, active).solve_normal(gradient);
  EXPECT_LT((found - expected).norm(), 1e-11 * expected.norm());
}

TEST_P(SubproblemFoldings, InverseGramDiagonal) {
  const TermSet active{0, 3, 7};
  const Matrix columns = theta_(Eigen::all, active);
  const Vector expected = (columns.transpose() * columns).inverse().diagonal();
  const Vector found = system_.subproblem(0, active).inverse_gram_diagonal();
  EXPECT_LT((found.cwiseQuotient(expected).array() - 1.0).abs().maxCoeff(), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Foldings, SubproblemFoldings,
                         ::testing::Values(Folding::Automatic, Folding::Gram,
                                           Folding::Orthogonal, Folding::Deflated));

TEST(Subproblem, WithoutTermsLeavesTheTarget) {
  const Matrix targets = Matrix::Random(50, 2);
  const auto system = system_of(Matrix::Random(50, 3), targets);
  Subproblem problem = system.subproblem(1, {1});
  problem.remove(0);
  for (const Subproblem& empty : {problem, system.subproblem(1, {})}) {
    EXPECT_EQ(empty.size(), 0);
    EXPECT_EQ(empty.solve().size(), 0);
    EXPECT_NEAR(empty.residual_norm(), targets.col(1).norm(), 1e-13);
    EXPECT_EQ(empty.condition(), 1.0);
    EXPECT_EQ(empty.inverse_gram_diagonal().size(), 0);
  }
}

TEST(Subproblem, ConditionIsThatOfScaledColumns) {
  Matrix theta = Matrix::Random(300, 2);
  theta.col(1) = theta.col(0) + 1e-4 * theta.col(1);
  const double condition =
      system_of(theta, Matrix::Random(300, 1)).subproblem(0, {0, 1}).condition();
  theta.col(1) *= 1e5;
  const double scaled =
      system_of(theta, Matrix::Random(300, 1)).subproblem(0, {0, 1}).condition();
  EXPECT_GT(condition, 1e4);
  EXPECT_LT(condition, 1e5);
  EXPECT_NEAR(scaled / condition, 1.0, 1e-6);
}

TEST(Subproblem, RefusesBadNumbers) {
  const auto system = system_of(Matrix::Random(20, 3), Matrix::Random(20, 1));
  EXPECT_THROW(system.subproblem(1, {0}), ArgumentError);
  EXPECT_THROW(system.subproblem(0, {3}), ArgumentError);
  EXPECT_THROW(system.subproblem(0, {-1, 2}), ArgumentError);
  EXPECT_THROW(system.subproblem(0, {1, 0}), ArgumentError);
  EXPECT_THROW(system.subproblem(0, {1, 1}), ArgumentError);
  Subproblem problem = system.subproblem(0, {0, 2});
  EXPECT_THROW(problem.remove(2), ArgumentError);
  EXPECT_THROW(problem.remove(-1), ArgumentError);
}

TEST(Subproblem, RenumberedKeepsTheNumbers) {
  const auto system = system_of(Matrix::Random(20, 2), Matrix::Random(20, 1));
  const Subproblem problem = system.subproblem(0, {0, 1});
  const Subproblem renumbered = problem.renumbered(2, {3, 8});
  EXPECT_EQ(renumbered.target(), 2);
  EXPECT_EQ(renumbered.active(), (TermSet{3, 8}));
  EXPECT_EQ(renumbered.solve(), problem.solve());
}

TEST(Subproblem, CoefficientsHaveToFit) {
  const LeastSquaresSystem system(make_row_source(Matrix::Identity(4, 2), Matrix::Ones(4, 1)),
                                  {"a", "b"}, {"y"});
  const Subproblem problem = system.subproblem(0, {0, 1});
  EXPECT_THROW(problem.solve_normal(Vector::Ones(1)), ArgumentError);
  EXPECT_THROW(problem.residual_norm(Vector::Ones(3)), ArgumentError);
  EXPECT_THROW(problem.renumbered(0, {0}), ArgumentError);
}

}  // namespace
}  // namespace lacuna
