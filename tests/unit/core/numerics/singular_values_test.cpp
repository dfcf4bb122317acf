// SPDX-License-Identifier: MIT
#include "core/numerics/singular_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/eigenvalues.hpp"
#include "core/numerics/qr.hpp"
#include "core/numerics/symmetric_eigen.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/numerics/negligible.hpp"

namespace lacuna {
namespace {

/// Columns 1 and 2 of three are the same but for a factor of 2.
Matrix dependent_columns() {
  Matrix a(4, 3);
  a << 1, 2, 0, 2, 4, 1, 3, 6, -1, 0, 0, 2;
  return a;
}

TEST(SingularValues, ProductIsTheMatrix) {
  const Matrix a = dependent_columns();
  const SingularValues found = singular_values(a);
  EXPECT_TRUE((found.left * found.values.asDiagonal() * found.right.transpose()).isApprox(a));
}

TEST(SingularValues, NoRowsTellNothing) {
  const SingularValues found = singular_values(Matrix(0, 3));
  EXPECT_EQ(found.rank(0.1), 0);
  EXPECT_EQ(found.null_space(0.1), Matrix(Matrix::Identity(3, 3)));
}

TEST(SingularValues, SquaresAreThoseOfTheGramMatrix) {
  // Of [3 0; 4 5]: a'a = [25 20; 20 25] with the eigenvalues 45 and 5.
  Matrix a(2, 2);
  a << 3, 0, 4, 5;
  const SingularValues found = singular_values(a);
  EXPECT_NEAR(found.values[0] * found.values[0], 45.0, 1e-12);
  EXPECT_NEAR(found.values[1] * found.values[1], 5.0, 1e-12);
}

TEST(SingularValues, NullSpaceIsTheDependence) {
  const Matrix null = singular_values(dependent_columns()).null_space(1e-12);
  ASSERT_EQ(null.cols(), 1);
  EXPECT_NEAR(null(0, 0) / null(1, 0), -2.0, 1e-12);
  EXPECT_NEAR(null(2, 0), 0.0, 1e-12);
}

TEST(SingularValues, FewerRowsThanColumnsLeaveTheRestUndetermined) {
  const SingularValues found = singular_values(dependent_columns().topRows(1));
  EXPECT_EQ(found.rank(1e-12), 1);
  EXPECT_EQ(found.null_space(1e-12).cols(), 2);
}

TEST(SingularValues, OfNoColumnsAndOfNan) {
  const SingularValues none = singular_values(Matrix(3, 0));
  EXPECT_EQ(none.values.size(), 0);
  EXPECT_EQ(none.right.size(), 0);
  const Matrix nan = Matrix::Constant(3, 2, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(singular_values(nan).values.array().isNaN().all());
}

TEST(SymmetricEigen, ValuesRiseAndVectorsAreOrthonormal) {
  // [2 1; 1 2] has the values 1 and 3 in the directions (1, -1) and (1, 1).
  const SymmetricEigen found = symmetric_eigen(Matrix{{2.0, 1.0}, {1.0, 2.0}});
  EXPECT_NEAR(found.values[0], 1.0, 1e-14);
  EXPECT_NEAR(found.values[1], 3.0, 1e-14);
  EXPECT_NEAR(found.vectors(0, 0) / found.vectors(1, 0), -1.0, 1e-14);
  EXPECT_TRUE((found.vectors.transpose() * found.vectors).isIdentity(1e-14));
}

TEST(SymmetricEigen, OfAPairIsScaledByTheSecond) {
  // diag(8, 3) v = lambda diag(2, 1) v: 3 and 4; vectors have v'Bv = 1.
  const auto found =
      symmetric_eigen(Matrix{{8.0, 0.0}, {0.0, 3.0}}, Matrix{{2.0, 0.0}, {0.0, 1.0}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->values[0], 3.0, 1e-14);
  EXPECT_NEAR(found->values[1], 4.0, 1e-14);
  EXPECT_NEAR(std::abs(found->vectors(0, 1)), std::sqrt(0.5), 1e-14);
}

TEST(SymmetricEigen, OfNothingIsNothingAndOfNanIsNan) {
  EXPECT_EQ(symmetric_eigen(Matrix()).values.size(), 0);
  EXPECT_EQ(symmetric_eigen(Matrix(), Matrix())->values.size(), 0);
  const Matrix nan = Matrix::Constant(2, 2, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(symmetric_eigen(nan).values.array().isNaN().all());
  EXPECT_FALSE(symmetric_eigen(nan, Matrix::Identity(2, 2)));
}

TEST(Eigenvalues, OfAnOscillatorAreItsDampingAndFrequency) {
  // x'' = -0.4 x' - 9.04 x: -0.2 +- sqrt(9.04 - 0.04) i.
  const auto found = eigenvalues(Matrix{{0.0, 1.0}, {-9.04, -0.4}});
  ASSERT_EQ(found.size(), 2u);
  for (const auto& value : found) {
    EXPECT_NEAR(value.real(), -0.2, 1e-12);
    EXPECT_NEAR(std::abs(value.imag()), 3.0, 1e-12);
  }
}

TEST(Eigenvalues, ThereAreNoneOfWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(eigenvalues(Matrix{{0.0, nan}, {1.0, 0.0}}).empty());
  EXPECT_THROW(eigenvalues(Matrix(2, 3)), ArgumentError);
}

TEST(NegligibleTerms, AreSmallAndDoNotExplainMostOfWhatIsLeft) {
  const NegligibleTerms rule;
  EXPECT_TRUE(rule.holds(9e-4, 9.0));
  EXPECT_FALSE(rule.holds(2e-3, 1.01));
  EXPECT_FALSE(rule.holds(9e-4, 11.0));
}

TEST(NegligibleTerms, BelowTheResolutionNothingIsMeant) {
  EXPECT_TRUE(NegligibleTerms().holds(5e-8, 1e6));
  EXPECT_FALSE(NegligibleTerms{.effect_size = 0.0}.holds(0.0, 1.0));
}

TEST(NegligibleTerms, BesideAFloorATermHasToExplainMoreThanTheRest) {
  const NegligibleTerms rule = NegligibleTerms().beside_a_floor();
  EXPECT_TRUE(rule.holds(9e-3, 1.3));
  EXPECT_FALSE(rule.holds(9e-3, 1.5));
  EXPECT_FALSE(rule.holds(2e-2, 1.3));
}

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
