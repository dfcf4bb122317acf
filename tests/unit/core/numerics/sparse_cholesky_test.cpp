// SPDX-License-Identifier: MIT
#include "core/numerics/sparse_cholesky.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// B B' of a random lower band B, n x n, with `band` entries beside the diagonal.
Matrix banded(Index n, Index band) {
  Random random(5);
  Matrix lower = Matrix::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = std::max<Index>(0, i - band); j <= i; ++j)
      lower(i, j) = i == j ? 2.0 + random.uniform() : random.normal();
  return lower * lower.transpose();
}

TEST(SparseCholesky, IsTheDenseFactorAndKeepsTheBand) {
  constexpr Index kSize = 70, kBand = 4;
  const Matrix dense = banded(kSize, kBand);
  const SparseRows lower = sparse_cholesky(dense.sparseView());
  const Matrix expected = dense.llt().matrixL();
  EXPECT_LT((Matrix(lower) - expected).norm(), 1e-12 * expected.norm());
  EXPECT_EQ(lower.nonZeros(), kSize * (kBand + 1) - kBand * (kBand + 1) / 2);
}

TEST(SparseCholesky, SolvesAndInvertsAsTheDenseMatrixDoes) {
  constexpr Index kSize = 40;
  const Matrix dense = banded(kSize, 3);
  const SparseRows lower = sparse_cholesky(dense.sparseView());
  const Matrix right = Matrix::Identity(kSize, 2);
  const Matrix inverse = dense.inverse();
  EXPECT_LT((solve_by_factor(lower, right) - inverse.leftCols(2)).norm(), 1e-10 * inverse.norm());
  const Matrix band = inverse_band(lower);
  ASSERT_EQ(band.rows(), 4);
  for (Index d = 0; d < 4; ++d)
    for (Index j = 0; j + d < kSize; ++j)
      EXPECT_NEAR(band(d, j), inverse(j + d, j), 1e-10 * inverse.norm());
}

TEST(SparseCholesky, RefusesWhatIsNotPositiveDefinite) {
  Matrix dense = banded(9, 2);
  dense(4, 4) = -1.0;
  EXPECT_THROW(sparse_cholesky(dense.sparseView()), ArgumentError);
}

TEST(SparseCholesky, IsByCholmodWhereThatIsBuiltIn) {
  EXPECT_EQ(sparse_cholesky_back_end(), HAS_CHOLMOD ? "CHOLMOD" : "Eigen");
}

}  // namespace
}  // namespace lacuna
