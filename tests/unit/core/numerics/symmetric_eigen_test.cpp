// SPDX-License-Identifier: MIT
#include "core/numerics/symmetric_eigen.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
