// SPDX-License-Identifier: MIT
#include "lacuna/core/statistics/interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(StudentQuantile, OfABandAgreesWithTables) {
  EXPECT_NEAR(student_quantile_95(1.0), 6.3137515, 1e-7);
  EXPECT_NEAR(student_quantile_95(10.0), 1.8124611, 1e-7);
  EXPECT_NEAR(student_quantile_95(1e9), 1.6448536, 1e-7);
  EXPECT_THROW(student_quantile_95(0.5), ArgumentError);
}

TEST(StudentQuantile, GoesOnBetweenWholeDegreesOfFreedom) {
  const double between = student_quantile_975(1.5);
  EXPECT_LT(between, 0.6 * student_quantile_975(1.0));
  EXPECT_GT(between, student_quantile_975(2.0));
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

}  // namespace
}  // namespace lacuna
