// SPDX-License-Identifier: MIT
#include "trajectories/design/precision.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

/// [[4, 1], [1, 3]]: determinant 11, inverse [[3, -1], [-1, 4]] / 11, eigenvalues (7 -+ sqrt
/// 5)/2.
Matrix information() {
  Matrix m(2, 2);
  m << 4.0, 1.0, 1.0, 3.0;
  return m;
}

TEST(PrecisionOf, IsTheFormulaOfEachCriterion) {
  const Vector one = Vector::Ones(2);
  const double low = 0.5 * (7.0 - std::sqrt(5.0)), high = 0.5 * (7.0 + std::sqrt(5.0));
  const auto of = [&](PrecisionCriterion criterion) {
    return precision_of(information(), one, criterion, {1});
  };
  EXPECT_NEAR(of(PrecisionCriterion::D), std::log(11.0), 1e-12);
  EXPECT_NEAR(of(PrecisionCriterion::A), -std::log(7.0 / 11.0), 1e-12);
  EXPECT_NEAR(of(PrecisionCriterion::E), std::log(low), 1e-12);
  EXPECT_NEAR(of(PrecisionCriterion::ModifiedE), std::log(low / high), 1e-12);
  EXPECT_NEAR(of(PrecisionCriterion::Chosen), -std::log(4.0 / 11.0), 1e-12);
}

TEST(PrecisionOf, UnitsDoNotMatter) {
  // The second number in thousandths: its information is a millionth, its size thousandfold.
  Vector size(2), unit(2);
  size << 2.0, 5.0;
  unit << 1.0, 1e-3;
  const Vector other = size.cwiseQuotient(unit);
  const Matrix same = unit.asDiagonal() * information() * unit.asDiagonal();
  for (const auto criterion : {PrecisionCriterion::D, PrecisionCriterion::A,
                               PrecisionCriterion::E, PrecisionCriterion::ModifiedE})
    EXPECT_NEAR(precision_of(same, other, criterion),
                precision_of(information(), size, criterion), 1e-9);
}

TEST(StandardErrors, AreRootsOfTheInverse) {
  const Vector errors = standard_errors(information(), Vector::Constant(2, 3.0));
  EXPECT_NEAR(errors[0], std::sqrt(3.0 / 11.0), 1e-12);
  EXPECT_NEAR(errors[1], std::sqrt(4.0 / 11.0), 1e-12);
}

TEST(StandardErrors, OfAnOpenDirectionThereAreNone) {
  // a + b is known, c is known, a - b is not.
  Matrix m = Matrix::Zero(3, 3);
  m.topLeftCorner(2, 2).setOnes();
  m(2, 2) = 4.0;
  const Vector errors = standard_errors(m, Vector::Ones(3));
  EXPECT_TRUE(std::isnan(errors[0]));
  EXPECT_TRUE(std::isnan(errors[1]));
  EXPECT_NEAR(errors[2], 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(standard_errors(Matrix::Zero(1, 1), Vector::Ones(1))[0]));
}

}  // namespace
}  // namespace lacuna
