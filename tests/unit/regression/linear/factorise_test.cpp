// SPDX-License-Identifier: MIT
#include "regression/linear/factorise.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

const auto name_of_column = [](Index column) { return "column " + std::to_string(column); };

Factor factor_of(const Matrix& theta, const Matrix& targets,
                 Folding folding = Folding::Automatic) {
  return factorise(*make_row_source(theta, targets), folding, name_of_column);
}

// |R - R'| for factors that may differ in rounding only.
double distance(const Factor& a, const Factor& b) {
  return (a.triangle - b.triangle).cwiseAbs().maxCoeff();
}

TEST(Factorise, BothFoldingsGiveTheSameFactor) {
  const Matrix theta = Matrix::Random(2000, 7);
  const Matrix targets = Matrix::Random(2000, 2);
  const Factor gram = factor_of(theta, targets, Folding::Gram);
  const Factor orthogonal = factor_of(theta, targets, Folding::Orthogonal);
  EXPECT_EQ(gram.folding, Folding::Gram);
  EXPECT_EQ(orthogonal.folding, Folding::Orthogonal);
  EXPECT_LT(distance(gram, orthogonal), 1e-12);
  EXPECT_LT((gram.column_norms - theta.colwise().norm().transpose()).norm(), 1e-11);
  EXPECT_LT((gram.target_norms - targets.colwise().norm().transpose()).norm(), 1e-11);
  EXPECT_EQ(gram.rows, 2000);
}

TEST(Factorise, KeepsTheGramOfWideRowsThatWereFoldedByIt) {
  const Matrix theta = Matrix::Random(600, kWideTerms + 1), y = Matrix::Random(600, 1);
  const Factor factor = factor_of(theta, y);
  Matrix all(600, theta.cols() + 1);
  all << theta, y;
  ASSERT_EQ(factor.gram.rows(), all.cols());
  EXPECT_LT((factor.gram - all.transpose() * all).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_EQ(factor_of(theta, y, Folding::Orthogonal).gram.size(), 0);
  EXPECT_EQ(factor_of(theta.leftCols(kWideTerms), y).gram.size(), 0);
}

TEST(Factorise, AutomaticSwitchesForDependentColumns) {
  Matrix theta = Matrix::Random(500, 4);
  theta.col(2) = theta.col(1);
  const Factor factor = factor_of(theta, Matrix::Random(500, 1));
  EXPECT_EQ(factor.folding, Folding::Orthogonal);
  EXPECT_TRUE(factor.triangle.allFinite());
}

TEST(Factorise, AutomaticSwitchesForIllConditionedColumns) {
  Matrix theta = Matrix::Random(500, 4);
  theta.col(2) = theta.col(1) + 2e-8 * theta.col(2);
  EXPECT_EQ(factor_of(theta, Matrix::Random(500, 1)).folding, Folding::Orthogonal);
}

TEST(Factorise, AutomaticSwitchesForExactTargets) {
  const Matrix theta = Matrix::Random(500, 4);
  Matrix targets = Matrix::Random(500, 2);
  targets.col(1) = theta.col(0) - theta.col(3) + 1e-8 * targets.col(0);
  EXPECT_EQ(factor_of(theta, targets).folding, Folding::Orthogonal);
}

// Powers of a variable, condition about 1e3; exact targets beside one with noise and one of
// which nothing is left.
struct ExactProblem {
  Matrix theta = Matrix(4000, 6);
  Matrix truth = Matrix::Random(6, 3);
  Matrix targets;

  ExactProblem() {
    const Vector x = 1.2 + Vector::Random(4000).array();
    for (Index j = 0; j < 6; ++j) theta.col(j) = x.array().pow(double(j));
    truth.col(2) = Vector::Unit(6, 1);
    targets = theta * truth;
    targets.col(2) = theta.col(1);
  }
};

TEST(Factorise, DeflatedIsAsAccurateAsOrthogonal) {
  ExactProblem problem;
  problem.targets.col(1) += 1e-2 * Vector::Random(4000);
  const Factor deflated = factor_of(problem.theta, problem.targets, Folding::Deflated);
  const Factor orthogonal = factor_of(problem.theta, problem.targets, Folding::Orthogonal);
  ASSERT_EQ(deflated.folding, Folding::Deflated);
  EXPECT_LT((deflated.triangle - orthogonal.triangle).topRows(6).cwiseAbs().maxCoeff(), 1e-7);
  const auto residual = [](const Factor& factor) {
    return factor.triangle.col(7).tail(3).norm();
  };
  EXPECT_NEAR(residual(deflated), residual(orthogonal), 1e-10);
  EXPECT_LT((deflated.target_norms - orthogonal.target_norms).norm(), 1e-10);
  const auto left = [](const Factor& factor) { return factor.triangle(6, 6); };
  EXPECT_LT(left(deflated), 1e-14 * deflated.target_norms[0]);
  const Vector h = deflated.triangle.topLeftCorner(6, 6)
                       .triangularView<Eigen::Upper>()
                       .solve(deflated.triangle.col(6).head(6))
                       .cwiseQuotient(deflated.column_norms);
  EXPECT_LT((h - problem.truth.col(0)).cwiseAbs().maxCoeff(), 1e-11);
}

// Behind the first of some rows, and before the next ones.
constexpr Index kBetween = 2500;

TEST(Factorise, DeflatedSeesWhatOtherRowsLeave) {
  ExactProblem problem;
  Matrix theta(40'000, 6), targets(40'000, 3);
  theta << problem.theta.replicate(10, 1);
  targets << problem.targets.replicate(10, 1);
  targets.middleRows(kBetween, 2000) += 1e-9 * Matrix::Random(2000, 3);
  const Factor deflated = factor_of(theta, targets, Folding::Deflated);
  const Factor orthogonal = factor_of(theta, targets, Folding::Orthogonal);
  ASSERT_EQ(deflated.folding, Folding::Deflated);
  const Factor gram = factor_of(theta, targets, Folding::Gram);
  for (Index k = 0; k < 3; ++k) {
    const auto left = [&](const Factor& factor) {
      return factor.triangle.col(6 + k).tail(3).norm();
    };
    EXPECT_NEAR(left(deflated), left(orthogonal), 1e-3 * left(orthogonal));
    EXPECT_GT(std::abs(left(gram) - left(orthogonal)), 0.5 * left(orthogonal));  // too little
  }
}

TEST(Factorise, DeflatedGivesWayWhereSomeRowsDoNotDetermineTheTerms) {
  ExactProblem problem;
  Matrix theta(70'000, 6);
  theta << problem.theta.replicate(18, 1).topRows(70'000);
  const Vector between = theta.col(5).segment(kBetween, 2000);
  theta.col(5).setZero();
  theta.col(5).segment(kBetween, 2000) = between;
  const Factor factor = factor_of(theta, theta * problem.truth, Folding::Deflated);
  EXPECT_EQ(factor.folding, Folding::Orthogonal);
}

// Some rows hardly tell two terms from each other, so that what their fit leaves of the others
// is little, and all of it explained.
TEST(Factorise, DeflatedTakesAFitThatIsNotExact) {
  Matrix theta = Matrix::Random(60'000, 4);
  const Vector between = theta.col(3).segment(kBetween, 2000);
  theta.col(3) = theta.col(2) + 1e-6 * theta.col(3);
  theta.col(3).segment(kBetween, 2000) = between;
  const Vector truth = Vector::LinSpaced(4, 1.0, 2.0);
  const Factor factor = factor_of(theta, theta * truth, Folding::Deflated);
  ASSERT_EQ(factor.folding, Folding::Deflated);
  EXPECT_LT(factor.triangle(4, 4), 1e-14 * factor.target_norms[0]);
  const Vector h = factor.triangle.topLeftCorner(4, 4)
                       .triangularView<Eigen::Upper>()
                       .solve(factor.triangle.col(4).head(4))
                       .cwiseQuotient(factor.column_norms);
  EXPECT_LT((h - truth).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Factorise, AutomaticDeflatesVeryManyRowsOfExactTargets) {
  const Matrix theta = Matrix::Random(kManyRows, 3);
  const Matrix exact = theta * Matrix::Random(3, 2);
  EXPECT_EQ(factor_of(theta, exact).folding, Folding::Deflated);
  EXPECT_EQ(factor_of(theta, exact + 1e-3 * Matrix::Random(kManyRows, 2)).folding,
            Folding::Gram);
}

class FactoriseExtremes : public ::testing::TestWithParam<Folding> {};

TEST_P(FactoriseExtremes, ScaleDropsOutOfTheTriangle) {
  const Matrix theta = Matrix::Random(500, 3);
  const Matrix targets = Matrix::Random(500, 1);
  Matrix extreme = theta;
  extreme.col(0) *= 1e-280;
  extreme.col(2) *= 1e280;
  const Factor plain = factor_of(theta, targets, GetParam());
  const Factor scaled = factor_of(extreme, targets * 1e-200, GetParam());
  EXPECT_LT((plain.triangle.leftCols(3) - scaled.triangle.leftCols(3)).norm(), 1e-12);
  EXPECT_LT((plain.triangle.col(3) - 1e200 * scaled.triangle.col(3)).norm(), 1e-12);
  EXPECT_NEAR(scaled.column_norms[0] * 1e280, plain.column_norms[0], 1e-11);
  EXPECT_NEAR(scaled.column_norms[2] / 1e280, plain.column_norms[2], 1e-11);
  EXPECT_NEAR(scaled.target_norms[0] * 1e200, plain.target_norms[0], 1e-11);
}

TEST_P(FactoriseExtremes, TakesNoRows) {
  const Factor factor = factor_of(Matrix(0, 3), Matrix(0, 1), GetParam());
  EXPECT_EQ(factor.rows, 0);
  EXPECT_TRUE(factor.triangle.isZero(0.0));
}

INSTANTIATE_TEST_SUITE_P(Foldings, FactoriseExtremes,
                         ::testing::Values(Folding::Automatic, Folding::Gram,
                                           Folding::Orthogonal, Folding::Deflated));

}  // namespace
}  // namespace lacuna
