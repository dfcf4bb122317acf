// SPDX-License-Identifier: MIT
#include "regression/linear/gram.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(FoldGram, IsTheProductOverAllSlots) {
  const Matrix theta = Matrix::Random(70'001, 5);
  const Matrix targets = Matrix::Random(70'001, 2);
  Matrix all(70'001, 7);
  all << theta, targets;
  const Matrix expected = all.transpose() * all;
  const Matrix gram = fold_gram(*make_row_source(theta, targets));
  EXPECT_LT((gram - expected).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(gram, gram.transpose());
}

TEST(FoldDeflatedGram, IsTheProductOfWhatCoefficientsLeave) {
  const Matrix theta = Matrix::Random(40'001, 5);
  const Matrix targets = Matrix::Random(40'001, 2);
  const Matrix h = Matrix::Random(5, 2);
  Matrix all(40'001, 7);
  all << theta, targets - theta * h;
  const Matrix expected = all.transpose() * all;
  const Matrix gram = fold_deflated_gram(*make_row_source(theta, targets), h);
  EXPECT_LT((gram - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(FoldGram, OfNoRowsIsZero) {
  EXPECT_TRUE(fold_gram(*make_row_source(Matrix(0, 2), Matrix(0, 1))).isZero(0.0));
}

TEST(FactorGram, ReproducesTheScaledGram) {
  const Matrix values = Matrix::Random(100, 6) * Vector::LinSpaced(6, 1.0, 1e4).asDiagonal();
  const Matrix gram = values.transpose() * values;
  const GramFactor factor = factor_gram(gram, 6);
  const Vector norms = gram.diagonal().cwiseSqrt();
  const Matrix scaled = factor.triangle * norms.asDiagonal();
  EXPECT_FALSE(factor.broke_down);
  EXPECT_LT((scaled.transpose() * scaled - gram).norm(), 1e-13 * gram.norm());
  EXPECT_TRUE(factor.triangle.isUpperTriangular(0.0));
}

TEST(FactorGram, SaysWhenColumnsDepend) {
  Matrix values = Matrix::Random(100, 4);
  values.col(2) = values.col(0) - 3.0 * values.col(1);
  const GramFactor factor = factor_gram(values.transpose() * values, 3);
  EXPECT_TRUE(factor.broke_down);
  EXPECT_TRUE(factor.triangle.row(2).isZero(0.0));
  EXPECT_TRUE(factor.triangle.allFinite());
}

TEST(FactorGram, BreaksDownWhereThePivotIsRounding) {
  // Of two unit columns at the angle s the second has the pivot s^2.
  const auto breaks_down = [](double s) {
    Matrix values = Matrix::Zero(2, 3);
    values << 1.0, std::cos(s), 1.0, 0.0, std::sin(s), 1.0;
    return factor_gram(values.transpose() * values, 2).broke_down;
  };
  EXPECT_FALSE(breaks_down(1e-6));
  EXPECT_FALSE(breaks_down(1e-7));
  EXPECT_TRUE(breaks_down(3e-8));
  EXPECT_TRUE(breaks_down(1e-8));
}

TEST(FactorGram, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(factor_gram(Matrix::Identity(3, 3), 3, {.stop = source.get_token()}), Cancelled);
}

TEST(FactorGram, TakesColumnsOfZerosAndExactTargets) {
  Matrix values = Matrix::Random(100, 4);
  values.col(1).setZero();
  values.col(3) = values.col(0);
  const GramFactor factor = factor_gram(values.transpose() * values, 3);
  EXPECT_FALSE(factor.broke_down);
  EXPECT_TRUE(factor.triangle.col(1).isZero(0.0));
  EXPECT_TRUE(factor.triangle.allFinite());
}

TEST(Gram, ShapesHaveToFit) {
  const auto rows = make_row_source(Matrix::Ones(4, 2), Matrix::Ones(4, 1));
  EXPECT_THROW(fold_deflated_gram(*rows, Matrix::Ones(2, 2)), ArgumentError);
  EXPECT_THROW(factor_gram(Matrix::Ones(3, 2), 1), ArgumentError);
}

}  // namespace
}  // namespace lacuna
