// SPDX-License-Identifier: MIT
#include "regression/linear/gram.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(FactorGram, BreaksDownWhereThePivotIsRounding) {
  // Of two unit columns at the angle s the second has the pivot s^2.
  const auto breaks_down = [](double s) {
    Matrix values = Matrix::Zero(2, 3);
    values << 1.0, std::cos(s), 1.0, 0.0, std::sin(s), 1.0;
    return factor_gram(values.transpose() * values, 2).broke_down;
  };
  EXPECT_FALSE(breaks_down(1e-6));
  EXPECT_FALSE(breaks_down(1e-7));
  EXPECT_TRUE(breaks_down(3e-8));
  EXPECT_TRUE(breaks_down(1e-8));
}

}  // namespace
}  // namespace lacuna
