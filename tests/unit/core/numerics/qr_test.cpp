// SPDX-License-Identifier: MIT
#include "core/numerics/qr.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Matrix tall() {
  Matrix a(4, 3);
  a << 1, 2, 0, 2, 4, 1, 3, -1, -1, 0, 5, 2;
  return a;
}

/// The third column is the first less twice the second.
Matrix dependent() {
  Matrix a = tall();
  a.col(2) = a.col(0) - 2.0 * a.col(1);
  return a;
}

TEST(Qr, BasisTimesTriangleIsTheMatrix) {
  const Qr qr(tall());
  EXPECT_TRUE((qr.basis() * qr.triangle()).isApprox(tall()));
  EXPECT_TRUE((qr.basis().transpose() * qr.basis()).isIdentity(1e-14));
  EXPECT_TRUE(qr.triangle().isUpperTriangular(0.0));
}

TEST(Qr, TriangleHasTheGramMatrixOfTheColumns) {
  const Matrix r = Qr(tall()).triangle();
  EXPECT_TRUE((r.transpose() * r).isApprox(tall().transpose() * tall()));
}

TEST(Qr, WideMatricesHaveAsManyRowsAsTheyHad) {
  const Qr qr(tall().transpose());
  EXPECT_EQ(qr.triangle().rows(), 3);
  EXPECT_TRUE((qr.basis() * qr.triangle()).isApprox(tall().transpose()));
}

TEST(Qr, TransposedTimesUndoesTimes) {
  const Qr qr(tall());
  const Matrix b = Matrix::Random(4, 2);
  EXPECT_TRUE(qr.transposed_times(qr.times(b)).isApprox(b));
  Matrix padded = Matrix::Zero(4, 3);
  padded.topRows(3) = qr.triangle();
  EXPECT_TRUE(qr.times(padded).isApprox(tall()));
}

TEST(Qr, OnTheRightIsTheTransposeOfOnTheLeft) {
  const Qr qr(tall());
  const Matrix b = Matrix::Random(5, 4);
  Matrix turned = b;
  qr.apply_on_the_right(turned);
  EXPECT_TRUE(turned.isApprox(qr.transposed_times(b.transpose()).transpose()));
}

TEST(PivotedQr, ColumnsInOrderAreBasisTimesTriangle) {
  const PivotedQr qr(tall());
  ASSERT_EQ(qr.rank(), 3);
  const Matrix ordered = tall()(Eigen::all, qr.order());
  EXPECT_TRUE((ordered * qr.inverse_triangle()).isApprox(qr.basis()));
  EXPECT_NEAR(qr.pivots()[0], tall().colwise().norm().maxCoeff(), 1e-14);
}

TEST(PivotedQr, DependentColumnsComeLastAndGetNothing) {
  const PivotedQr qr(dependent());
  EXPECT_EQ(qr.rank(), 2);
  EXPECT_EQ(qr.basis().cols(), 2);
  const Vector b = dependent() * Vector{{1.0, 1.0, 1.0}};
  const Vector h = qr.solve(b);
  EXPECT_TRUE((dependent() * h).isApprox(b));
  EXPECT_EQ(h[qr.order()[2]], 0.0);
}

TEST(PivotedQr, ComplementIsOrthogonalToTheColumns) {
  const PivotedQr qr(dependent());
  const Matrix rest = qr.complement();
  EXPECT_EQ(rest.cols(), 2);
  EXPECT_TRUE((rest.transpose() * rest).isIdentity(1e-14));
  EXPECT_LT((rest.transpose() * dependent()).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(PivotedQr, FractionOfTheLargestPivotSaysWhatIsDependent) {
  Matrix a = Matrix::Identity(3, 2);
  a(1, 1) = 1e-6;
  EXPECT_EQ(PivotedQr(a).rank(), 2);
  EXPECT_EQ(PivotedQr(a, 1e-5).rank(), 1);
  EXPECT_EQ(PivotedQr(a, 1e-7).rank(), 2);
}

TEST(OrthonormalBasis, LengthsOfColumnsDoNotMatter) {
  Matrix a = dependent();
  a.col(0) *= 1e9;
  a.col(1) *= 1e-9;
  const Matrix basis = orthonormal_basis(a);
  ASSERT_EQ(basis.cols(), 2);
  const Matrix expected = PivotedQr(dependent()).basis();
  EXPECT_TRUE((basis * basis.transpose()).isApprox(expected * expected.transpose(), 1e-12));
}

TEST(OrthonormalBasis, OfNothingIsNothing) {
  EXPECT_EQ(orthonormal_basis(Matrix(3, 0)).cols(), 0);
  EXPECT_EQ(orthonormal_basis(Matrix(3, 0)).rows(), 3);
}

TEST(PivotedQr, OfNothingHasTheIdentity) {
  for (const auto& [rows, columns] : {std::pair<Index, Index>{0, 3}, {3, 0}, {0, 0}}) {
    const PivotedQr factor(Matrix(rows, columns));
    EXPECT_EQ(factor.rank(), 0);
    EXPECT_EQ(factor.pivots().size(), 0);
    EXPECT_EQ(static_cast<Index>(factor.order().size()), columns);
    EXPECT_EQ(factor.basis().cols(), 0);
    EXPECT_EQ(factor.complement(), Matrix::Identity(rows, rows));
    EXPECT_EQ(factor.inverse_triangle().size(), 0);
    EXPECT_EQ(factor.solve(Vector(Vector::Ones(rows))), Vector::Zero(columns));
  }
}

}  // namespace
}  // namespace lacuna
