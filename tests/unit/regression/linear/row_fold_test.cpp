// SPDX-License-Identifier: MIT
#include "regression/linear/row_fold.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

namespace lacuna {
namespace {

Matrix reference_triangle(const Matrix& all) {
  const Matrix packed = all.householderQr().matrixQR().topRows(all.cols());
  Matrix r = packed.triangularView<Eigen::Upper>();
  for (Index i = 0; i < r.rows(); ++i) {
    if (r(i, i) < 0.0) r.row(i) *= -1.0;
  }
  return r;
}

double gram_error(const Matrix& triangle, const Matrix& all) {
  return (triangle.transpose() * triangle - all.transpose() * all).norm() / all.squaredNorm();
}

TEST(RowFold, RowsMayComeInEveryWay) {
  const Matrix all = Matrix::Random(700, 5);
  for (const Folding folding : {Folding::Gram, Folding::Orthogonal}) {
    RowFold fold(5, folding);
    fold.add(all.topRows(400).transpose());
    for (Index i = 400; i < 690; ++i) {
      double* row = fold.next_row();
      for (Index j = 0; j < 5; ++j) row[j * fold.stride()] = all(i, j);
    }
    fold.add_triangle(reference_triangle(all.bottomRows(10)));
    const auto triangle = fold.finish();
    ASSERT_TRUE(triangle.has_value());
    EXPECT_TRUE(triangle->isUpperTriangular(0.0));
    EXPECT_LT(gram_error(*triangle, all), 1e-13);
  }
}

TEST(RowFold, StartsAnewWhenFinished) {
  const Matrix all = Matrix::Random(40, 3);
  RowFold fold(3);
  fold.add(Matrix::Random(3, 300));
  fold.finish();
  fold.add(all.transpose());
  EXPECT_LT(gram_error(*fold.finish(), all), 1e-13);
}

TEST(RowFold, AGramThatCannotResolveTheColumnsSaysSo) {
  Matrix all = Matrix::Random(500, 3);
  all.col(1) = all.col(0) + 1e-7 * all.col(1);
  RowFold gram(3, Folding::Gram), orthogonal(3);
  gram.add(all.transpose());
  orthogonal.add(all.transpose());
  EXPECT_FALSE(gram.finish().has_value());
  const Matrix expected = reference_triangle(all);
  EXPECT_NEAR(std::abs((*orthogonal.finish())(1, 1)) / expected(1, 1), 1.0, 1e-6);
}

TEST(FoldOrthogonal, IsTheTriangleOfTheWholeMatrix) {
  for (const Index rows : {20, 1000, 70'001}) {
    const Matrix all = Matrix::Random(rows, 8);
    const Matrix r = fold_orthogonal(*make_row_source(all.leftCols(6), all.rightCols(2)));
    EXPECT_LT((r - reference_triangle(all)).norm(), 1e-12 * all.norm()) << rows;
    EXPECT_TRUE(r.isUpperTriangular(0.0));
  }
}

// Gram and Cholesky lose what is below 1e-8; reflections do not.
TEST(FoldOrthogonal, SeesTinyDifferencesOfColumns) {
  Matrix all = Matrix::Random(40'000, 3);
  const Vector bump = Vector::Random(40'000);
  all.col(1) = all.col(0) + 1e-12 * bump;
  const Matrix r = fold_orthogonal(*make_row_source(all.leftCols(2), all.rightCols(1)));
  const Vector direction = all.col(0).normalized();
  const double expected = (bump - direction * direction.dot(bump)).norm() * 1e-12;
  EXPECT_NEAR(r(1, 1) / expected, 1.0, 1e-2);
}

TEST(FoldOrthogonal, TakesFewerRowsThanColumns) {
  const Matrix all = Matrix::Random(3, 6);
  const Matrix r = fold_orthogonal(*make_row_source(all.leftCols(5), all.rightCols(1)));
  EXPECT_TRUE(r.allFinite());
  EXPECT_LT((r.transpose() * r - all.transpose() * all).norm(), 1e-13);
}

TEST(RowFold, FoldsOfPartsMergeToTheFoldOfAll) {
  const Matrix rows = Matrix::Random(4, 90);
  for (const Folding folding : {Folding::Gram, Folding::Orthogonal}) {
    RowFold part(4, folding), other(4, folding);
    part.add(rows.leftCols(31));
    other.add(rows.rightCols(59));
    part.merge(other);
    if (folding == Folding::Gram) {
      EXPECT_LT((part.gram() - rows * rows.transpose()).norm(), 1e-12 * rows.squaredNorm());
    }
    const Matrix triangle = *part.finish();
    EXPECT_LT((triangle.transpose() * triangle - rows * rows.transpose()).norm(),
              1e-12 * rows.squaredNorm());
  }
}

}  // namespace
}  // namespace lacuna
