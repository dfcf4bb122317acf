// SPDX-License-Identifier: MIT
#include "core/numerics/interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(NormalQuantile, IsTheLimitOfStudents) {
  EXPECT_NEAR(std::erf(kNormalQuantile975 / std::sqrt(2.0)), 0.95, 1e-15);
  EXPECT_NEAR(student_quantile_975(1e15), kNormalQuantile975, 1e-14);
}

TEST(Interval95, LiesAboutTheEstimate) {
  const auto normal = interval95(3.0, 0.5);
  EXPECT_DOUBLE_EQ(normal[0], 3.0 - 0.5 * kNormalQuantile975);
  EXPECT_DOUBLE_EQ(normal[1], 3.0 + 0.5 * kNormalQuantile975);
  EXPECT_EQ(interval95(3.0, 0.5, 2.0), (std::array<double, 2>{2.0, 4.0}));
}

TEST(StudentQuantile, RefusesLessThanOneDegreeOfFreedom) {
  EXPECT_THROW(student_quantile_975(0.0), ArgumentError);
}

}  // namespace
}  // namespace lacuna
