// SPDX-License-Identifier: MIT
#include "lacuna/linear/tall_skinny_qr.hpp"

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

}  // namespace
}  // namespace lacuna
