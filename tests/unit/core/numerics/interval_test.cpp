// SPDX-License-Identifier: MIT
#include "core/numerics/interval.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// Values of printed tables of Student's distribution, as many digits as they have.
TEST(StudentQuantile, AgreesWithTables) {
  EXPECT_NEAR(student_quantile_975(1.0), 12.7062047, 1e-7);
  EXPECT_NEAR(student_quantile_975(2.0), 4.3026527, 1e-7);
  EXPECT_NEAR(student_quantile_975(3.0), 3.1824463, 1e-7);
  EXPECT_NEAR(student_quantile_975(5.0), 2.5705818, 1e-7);
  EXPECT_NEAR(student_quantile_975(10.0), 2.2281389, 1e-7);
  EXPECT_NEAR(student_quantile_975(30.0), 2.0422725, 1e-7);
  EXPECT_NEAR(student_quantile_975(1e9), 1.9599640, 1e-7);
}

TEST(StudentQuantile, GoesOnBetweenWholeDegreesOfFreedom) {
  const double between = student_quantile_975(1.5);
  EXPECT_LT(between, 0.6 * student_quantile_975(1.0));
  EXPECT_GT(between, student_quantile_975(2.0));
}

TEST(StudentQuantile, RefusesLessThanOneDegreeOfFreedom) {
  EXPECT_THROW(student_quantile_975(0.0), ArgumentError);
}

}  // namespace
}  // namespace lacuna
