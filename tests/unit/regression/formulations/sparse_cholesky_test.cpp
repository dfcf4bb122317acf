// SPDX-License-Identifier: MIT
#include "regression/formulations/sparse_cholesky.hpp"

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
