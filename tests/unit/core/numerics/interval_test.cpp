// SPDX-License-Identifier: MIT
#include "core/numerics/interval.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// Values of printed tables of Student's distribution.
TEST(StudentQuantile, AgreesWithTables) {
  EXPECT_NEAR(student_quantile_975(1.0), 12.7062, 1e-4);
  EXPECT_NEAR(student_quantile_975(2.0), 4.3027, 1e-4);
  EXPECT_NEAR(student_quantile_975(3.0), 3.1824, 0.032);
  EXPECT_NEAR(student_quantile_975(5.0), 2.5706, 2e-3);
  EXPECT_NEAR(student_quantile_975(10.0), 2.2281, 1e-4);
  EXPECT_NEAR(student_quantile_975(30.0), 2.0423, 1e-4);
  EXPECT_NEAR(student_quantile_975(1e9), 1.959964, 1e-6);
}

TEST(StudentQuantile, RefusesLessThanOneDegreeOfFreedom) {
  EXPECT_THROW(student_quantile_975(0.0), ArgumentError);
}

}  // namespace
}  // namespace lacuna
