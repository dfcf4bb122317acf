// SPDX-License-Identifier: MIT
#include "lacuna/linear/factorise.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/error.hpp"

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

TEST(Factorise, TermColumnsHaveUnitNormAndTargetsTheirOwn) {
  const Factor factor = factor_of(1e3 * Matrix::Random(500, 4), 7.0 * Matrix::Random(500, 2));
  const Vector norms = factor.triangle.colwise().norm().transpose();
  EXPECT_LT((norms.head(4).array() - 1.0).abs().maxCoeff(), 1e-13);
  EXPECT_LT((norms.tail(2) - factor.target_norms).norm(), 1e-11);
}

TEST(Factorise, AutomaticKeepsTheGramForNoisyWellConditionedRows) {
  const Factor factor = factor_of(Matrix::Random(500, 4), Matrix::Random(500, 1));
  EXPECT_EQ(factor.folding, Folding::Gram);
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

TEST(Factorise, ZeroColumnsStayZeroAndAreNoReasonToSwitch) {
  Matrix theta = Matrix::Random(500, 4);
  theta.col(1).setZero();
  const Factor factor = factor_of(theta, Matrix::Random(500, 1));
  EXPECT_EQ(factor.folding, Folding::Gram);
  EXPECT_EQ(factor.column_norms[1], 0.0);
  EXPECT_TRUE(factor.triangle.col(1).isZero(0.0));
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

TEST_P(FactoriseExtremes, NamesAnEntryThatIsNotFinite) {
  Matrix theta = Matrix::Random(500, 3);
  theta(41, 2) = std::numeric_limits<double>::quiet_NaN();
  try {
    factor_of(theta, Matrix::Random(500, 1), GetParam());
    FAIL() << "not refused";
  } catch (const DataError& error) {
    EXPECT_EQ(error.where(), "column 2, row 42");
  }
}

TEST_P(FactoriseExtremes, TakesNoRows) {
  const Factor factor = factor_of(Matrix(0, 3), Matrix(0, 1), GetParam());
  EXPECT_EQ(factor.rows, 0);
  EXPECT_TRUE(factor.triangle.isZero(0.0));
}

INSTANTIATE_TEST_SUITE_P(Foldings, FactoriseExtremes,
                         ::testing::Values(Folding::Automatic, Folding::Gram,
                                           Folding::Orthogonal));

}  // namespace
}  // namespace lacuna
