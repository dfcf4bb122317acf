// SPDX-License-Identifier: MIT
#include "lacuna/regression/linear/factor.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(Factor, CountsTermsByTheirNorms) {
  Factor factor;
  EXPECT_EQ(factor.terms(), 0);
  factor.triangle = Matrix::Identity(5, 5);
  factor.column_norms = Vector::Ones(3);
  factor.target_norms = Vector::Ones(2);
  EXPECT_EQ(factor.terms(), 3);
  EXPECT_EQ(factor.folding, Folding::Gram);
}

}  // namespace
}  // namespace lacuna
