// SPDX-License-Identifier: MIT
// Products of padded matrices against Eigen's.
#include "core/numerics/small_matrix.hpp"

#include <gtest/gtest.h>

#include "support/joint_gaussian.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
