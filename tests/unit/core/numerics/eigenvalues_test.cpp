// SPDX-License-Identifier: MIT
#include "core/numerics/eigenvalues.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
