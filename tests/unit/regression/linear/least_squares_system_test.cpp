// SPDX-License-Identifier: MIT
// The factors of a system of rows, and problems with some of its terms.
#include "lacuna/regression/linear/least_squares_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <stop_token>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

const TermSet kAll{0, 1, 2, 3};

class System : public ::testing::Test {
 protected:
  static LeastSquaresSystem make(const Matrix& theta, const Matrix& targets,
                                 const RunContext& context = {},
                                 Folding folding = Folding::Automatic) {
    return LeastSquaresSystem(make_row_source(theta, targets), {"a", "b", "c", "d"}, {"u", "v"},
                              context, folding);
  }

  const Matrix theta_ = Matrix::Random(1000, 4);
  const Matrix targets_ = Matrix::Random(1000, 2);
};

TEST_F(System, KeepsTheSystematicErrorOfItsTargets) {
  const auto system = make(theta_, targets_);
  EXPECT_FALSE(system.target_error());
  EXPECT_EQ(*system.with_target_error(Vector{{0.1, 0.0}}).target_error(), (Vector{{0.1, 0.0}}));
  EXPECT_THROW(system.with_target_error(Vector{{0.1}}), ArgumentError);
  EXPECT_THROW(system.with_target_error(Vector{{0.1, -1.0}}), ArgumentError);
}

TEST_F(System, RefusesNamesThatDoNotFit) {
  const auto rows = make_row_source(theta_, targets_);
  EXPECT_THROW(LeastSquaresSystem(rows, {"a"}, {"u", "v"}), ArgumentError);
  EXPECT_THROW(LeastSquaresSystem(rows, {"a", "b", "c", "d"}, {"u"}), ArgumentError);
}

TEST_F(System, NamesTheTermAndTheRowThatAreNotFinite) {
  Matrix bad = theta_;
  bad(500, 1) = std::numeric_limits<double>::infinity();
  try {
    make(bad, targets_);
    FAIL() << "not refused";
  } catch (const DataError& error) {
    EXPECT_EQ(error.where(), "term 'b', row 501");
  }
  Matrix bad_targets = targets_;
  bad_targets(0, 1) = std::numeric_limits<double>::quiet_NaN();
  try {
    make(theta_, bad_targets);
    FAIL() << "not refused";
  } catch (const DataError& error) {
    EXPECT_EQ(error.where(), "target 'v', row 1");
  }
}

TEST_F(System, FactorIsTheSameToTheBitForAnyNumberOfThreads) {
  const Matrix theta = Matrix::Random(100'000, 4);
  const Matrix targets = Matrix::Random(100'000, 2);
  for (const Folding folding : {Folding::Gram, Folding::Orthogonal, Folding::Deflated}) {
    const auto one = make(theta, targets, {}, folding);
    for (const int threads : {2, 3, 8}) {
      RunContext context;
      context.threads = threads;
      EXPECT_EQ(one.factor().triangle,
                make(theta, targets, context, folding).factor().triangle);
    }
  }
}

TEST(ManyRows, DeflatedNeedNoRefinement) {
  const Matrix theta = Matrix::Random(kManyRows, 3);
  const Vector truth = Vector::LinSpaced(3, 1.0, 2.0);
  const LeastSquaresSystem system(make_row_source(theta, theta * truth), {"a", "b", "c"},
                                  {"y"});
  ASSERT_EQ(system.factor().folding, Folding::Deflated);
  const Subproblem problem = system.subproblem(0, system.all_terms());
  const Vector h = problem.solve();
  EXPECT_LT((h - truth).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_EQ(system.refined(problem, h), h);
}

TEST_F(System, RefinedAndResidualsAgreeWithTheMatrix) {
  const auto system = make(theta_, targets_);
  const TermSet active{0, 2, 3};
  const auto problem = system.subproblem(1, active);
  const Vector rough = problem.solve() + 1e-3 * Vector::Random(3);
  const Matrix columns = theta_(Eigen::all, active);
  const Vector exact = columns.colPivHouseholderQr().solve(targets_.col(1));
  EXPECT_LT((system.refined(problem, rough) - exact).norm(), 1e-13);
  const Vector expected = targets_.col(1) - columns * rough;
  EXPECT_LT((system.residuals(1, active, rough) - expected).norm(), 1e-13);
}

TEST_F(System, RefusesCoefficientsThatDoNotFit) {
  const auto system = make(theta_, targets_);
  const auto problem = system.subproblem(1, {0, 2});
  const Vector h = Vector::Ones(3);
  EXPECT_THROW(system.refined(problem, h), ArgumentError);
  EXPECT_THROW(system.residuals(1, {0, 2}, h), ArgumentError);
  EXPECT_THROW(system.residuals(2, kAll, Vector::Ones(4)), ArgumentError);
  EXPECT_THROW(system.residuals(0, {0, 4}, Vector::Ones(2)), ArgumentError);
}

TEST_F(System, EveryPassCanBeCancelled) {
  const auto system = make(theta_, targets_);
  const auto problem = system.subproblem(0, kAll);
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto ones = [](const Eigen::Ref<const Vector>&, Eigen::Ref<Vector> w) { w.setOnes(); };
  EXPECT_THROW(make(theta_, targets_, context), Cancelled);
  EXPECT_THROW(system.refined(problem, problem.solve(), context), Cancelled);
  EXPECT_THROW(system.residuals(0, kAll, problem.solve(), context), Cancelled);
  EXPECT_THROW(system.reweighted(problem, problem.solve(), ones, context), Cancelled);
}

TEST_F(System, WeightedPassEqualsExplicitWeighting) {
  const auto weights = [](const Eigen::Ref<const Vector>& r, Eigen::Ref<Vector> w) {
    w = r.cwiseAbs().cwiseMax(1e-3).cwiseInverse();
  };
  for (const Folding folding : {Folding::Automatic, Folding::Gram, Folding::Orthogonal}) {
    const auto system = make(theta_, targets_, {}, folding);
    const auto problem = system.subproblem(1, {0, 2, 3});
    const Vector h = problem.solve();
    const Subproblem weighted = system.reweighted(problem, h, weights);
    Vector w = system.residuals(1, {0, 2, 3}, h);
    weights(Vector(w), w);
    const Vector roots = w.cwiseSqrt();
    const Matrix columns = roots.asDiagonal() * theta_(Eigen::all, problem.active());
    const Vector target = roots.cwiseProduct(targets_.col(1));
    const Vector expected = columns.colPivHouseholderQr().solve(target);
    EXPECT_LT((weighted.solve() - expected).norm(), 1e-13);
    EXPECT_NEAR(weighted.residual_norm(), (target - columns * expected).norm(), 1e-12);
    EXPECT_NEAR(weighted.target_norm(), target.norm(), 1e-12);
    EXPECT_LT((weighted.column_norms() - columns.colwise().norm().transpose()).norm(), 1e-12);
    EXPECT_EQ(weighted.target(), 1);
    EXPECT_EQ(weighted.active(), problem.active());
  }
}

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
