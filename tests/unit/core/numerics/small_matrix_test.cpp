// SPDX-License-Identifier: MIT
#include "core/numerics/small_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/column_kernels.hpp"
#include "core/numerics/coordinate_sweep.hpp"
#include "support/joint_gaussian.hpp"

namespace lacuna {
namespace {

// Products of padded matrices against Eigen's.
/// A matrix in the memory of a shape.
template <class S>
typename S::Square padded(const S& shape, const Matrix& m) {
  typename S::Square result = shape.square();
  for (Index j = 0; j < m.cols(); ++j)
    for (Index i = 0; i < m.rows(); ++i) result[j * shape.stride() + i] = m(i, j);
  return result;
}

template <class S>
Matrix inner(const S& shape, const typename S::Square& square, Index size) {
  return Eigen::Map<const Matrix>(square.data(), shape.stride(), shape.size())
      .topLeftCorner(size, size);
}

TEST(Shape, ColumnsArePaddedToWholePacks) {
  for (const Index size : {1, 3, 4, 5, 9, 12, 17})
    with_shape(size, size, [&](const auto& shape) {
      EXPECT_EQ(shape.stride() % kLane, 0);
      EXPECT_GE(shape.stride(), size);
      EXPECT_GE(shape.size(), size);
      EXPECT_EQ(shape.states(), size);
    });
}

TEST(SmallMatrix, ProductsAreEigens) {
  Random random(4);
  for (const Index size : {1, 2, 3, 5, 8, 11, 18}) {
    const Matrix a = support::random_matrix(random, size, size, 1.0);
    const Matrix b = support::random_matrix(random, size, size, 1.0);
    with_shape(size, size, [&](const auto& shape) {
      const auto left = padded(shape, a), right = padded(shape, b);
      auto out = shape.square();
      product(shape, left.data(), right.data(), 1, shape.stride(), shape.size(), out.data());
      EXPECT_LT((inner(shape, out, size) - a * b).norm(), 1e-12);
      auto transposed = shape.square();
      product(shape, left.data(), right.data(), shape.stride(), 1, shape.size(),
              transposed.data());
      EXPECT_LT((inner(shape, transposed, size) - a * b.transpose()).norm(), 1e-12);
      auto vector = shape.column();
      multiply(shape, left.data(), right.data(), size, vector.data());
      EXPECT_LT((Eigen::Map<const Vector>(vector.data(), size) - a * b.col(0)).norm(), 1e-12);
      EXPECT_NEAR(dot(shape, left.data(), right.data()), a.col(0).dot(b.col(0)), 1e-12);
      add_outer(shape, 2.0, left.data(), right.data(), out.data());
      const Matrix sum = a * b + 2.0 * a.col(0) * b.col(0).transpose();
      EXPECT_LT((inner(shape, out, size) - sum).norm(), 1e-12);
    });
  }
}

constexpr Index kMost = 70;  // several vectors of any machine, and what is left of them

TEST(ColumnKernels, AnyValueThatIsNotFiniteIsSeen) {
  for (Index count = 0; count < kMost; ++count) {
    Vector values = Vector::Random(count);
    Vector copy = Vector::Zero(count + 1);
    EXPECT_TRUE(is_finite(values.data(), count));
    EXPECT_TRUE(copy_finite(values.data(), count, copy.data()));
    EXPECT_EQ(copy.head(count), values);
    EXPECT_EQ(copy[count], 0.0) << "is not its own";
    for (Index i = 0; i < count; ++i)
      for (const double bad : {std::nan(""), -std::numeric_limits<double>::infinity()}) {
        const double good = std::exchange(values[i], bad);
        EXPECT_FALSE(is_finite(values.data(), count)) << i << " of " << count;
        EXPECT_FALSE(copy_finite(values.data(), count, copy.data())) << i << " of " << count;
        values[i] = good;
      }
  }
}

TEST(ColumnKernels, TheLargestValuesAreFinite) {
  const Vector values = Vector::Constant(kMost, std::numeric_limits<double>::max());
  EXPECT_TRUE(is_finite(values.data(), kMost));
}

TEST(ColumnKernels, ProductsAreThoseOfEachRow) {
  for (Index count = 0; count < kMost; ++count) {
    const Vector a = Vector::Random(count), b = Vector::Random(count);
    Vector product = Vector::Zero(count + 1);
    multiply(a.data(), b.data(), count, product.data());
    for (Index i = 0; i < count; ++i) EXPECT_EQ(product[i], a[i] * b[i]);
    EXPECT_EQ(product[count], 0.0) << "is not its own";
    multiply(a.data(), a.data(), count, product.data());
    for (Index i = 0; i < count; ++i) EXPECT_EQ(product[i], a[i] * a[i]);
  }
}

TEST(ColumnKernels, DifferencesAreThoseOfNeighbours) {
  for (Index count = 0; count < kMost; ++count) {
    const Vector values = Vector::Random(count + 2);
    Vector x = values;
    difference(x.data(), count);
    for (Index i = 0; i < count; ++i) EXPECT_EQ(x[i], values[i + 1] - values[i]);
    EXPECT_EQ(x.tail(2), values.tail(2));
  }
}

const Matrix kGram{{1.0, 0.5, 0.0}, {0.5, 1.0, 0.0}, {0.0, 0.0, 0.0}};
const Vector kCorrelation{{1.0, 0.8, 0.0}};

Vector swept(const Vector& first, double second) {
  Vector z = Vector::Zero(3), slope = kCorrelation;
  for (int i = 0; i < 100; ++i) coordinate_sweep(kGram, {first, second}, z, slope);
  return z;
}

TEST(CoordinateSweep, WithoutPenaltyIsLeastSquares) {
  const Vector z = swept(Vector::Zero(3), 0.0);
  EXPECT_NEAR(z[0] + 0.5 * z[1], 1.0, 1e-14);
  EXPECT_NEAR(0.5 * z[0] + z[1], 0.8, 1e-14);
  EXPECT_EQ(z[2], 0.0) << "a column of zeros";
}

/// At the minimum 2 R'(c - R z)_j = first_j sign(z_j) + second z_j, or |2 R'(c - R z)_j| is
/// less.
TEST(CoordinateSweep, EndsAtTheMinimumOfBothPenalties) {
  const Vector first{{0.2, 1.2, 0.1}};
  const double second = 0.3;
  const Vector z = swept(first, second);
  const Vector slope = 2.0 * (kCorrelation - kGram * z);
  EXPECT_NEAR(slope[0], first[0] + second * z[0], 1e-14);
  EXPECT_EQ(z[1], 0.0);
  EXPECT_LE(std::abs(slope[1]), first[1]);
}

TEST(CoordinateSweep, KeepsTheSlopeUpToDate) {
  Vector z = Vector::Zero(3), slope = kCorrelation;
  const Vector none = Vector::Zero(3);
  EXPECT_DOUBLE_EQ(coordinate_sweep(kGram, {none}, z, slope), 1.0);
  EXPECT_LT((slope - (kCorrelation - kGram * z)).norm(), 1e-15);
}

}  // namespace
}  // namespace lacuna
