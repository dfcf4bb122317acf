// SPDX-License-Identifier: MIT
#include "core/statistics/truncated_normal.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace lacuna {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double below(double q) { return 0.5 * std::erfc(-q / std::numbers::sqrt2); }

double density(double q) {
  return std::isinf(q) ? 0.0 : std::exp(-0.5 * q * q) / std::sqrt(2.0 * std::numbers::pi);
}

double times(double limit, double power, double at) {
  return std::isinf(limit) ? 0.0 : std::pow(limit, power) * at;
}

// Moments of the recurrence E z^k = (k - 1) E z^(k-2) + (a^(k-1) f(a) - b^(k-1) f(b)) / P.
TEST(TruncatedNormal, MomentsAreThoseOfTheRecurrence) {
  for (const auto& [low, high] : std::array<std::array<double, 2>, 6>{
           {{-kInfinity, kInfinity}, {-1.0, 2.0}, {0.5, kInfinity}, {-kInfinity, -1.5},
            {-0.2, 0.3}, {2.0, 2.5}}}) {
    const double p = below(high) - below(low), a = density(low) / p, b = density(high) / p;
    const double m1 = a - b, m2 = 1.0 + times(low, 1.0, a) - times(high, 1.0, b);
    const double m3 = 2.0 * m1 + times(low, 2.0, a) - times(high, 2.0, b);
    const double m4 = 3.0 * m2 + times(low, 3.0, a) - times(high, 3.0, b);
    const TruncatedNormal found = truncated_normal(low, high);
    EXPECT_NEAR(found.log_probability, std::log(p), 1e-8);
    EXPECT_NEAR(found.mean, m1, 1e-8);
    EXPECT_NEAR(found.variance, m2 - m1 * m1, 1e-8);
    EXPECT_NEAR(found.third, m3 - 3.0 * m1 * m2 + 2.0 * std::pow(m1, 3), 1e-7);
    EXPECT_NEAR(found.fourth,
                m4 - 4.0 * m1 * m3 + 6.0 * m1 * m1 * m2 - 3.0 * std::pow(m1, 4), 1e-7);
  }
}

// Far out the density is exponential: mean 1/q behind the limit, variance 1/q^2.
TEST(TruncatedNormal, FarOutItIsExponential) {
  for (const double q : {1e3, 1e6}) {
    const TruncatedNormal above = truncated_normal(q, kInfinity);
    EXPECT_NEAR((above.mean - q) * q, 1.0, 1e-3);
    EXPECT_NEAR(above.variance * q * q, 1.0, 1e-5);
    EXPECT_NEAR(above.third * q * q * q, 2.0, 1e-4);
    EXPECT_NEAR(above.fourth * q * q * q * q, 9.0, 1e-3);
    const TruncatedNormal under = truncated_normal(-kInfinity, -q);
    EXPECT_DOUBLE_EQ(under.log_probability, above.log_probability);
    EXPECT_DOUBLE_EQ(under.mean, -above.mean);
    EXPECT_NEAR(under.third * q * q * q, -2.0, 1e-4);
  }
}

TEST(TruncatedNormal, BetweenNarrowLimitsItIsUniform) {
  const TruncatedNormal found = truncated_normal(1.0, 1.0 + 1e-6);
  EXPECT_NEAR(found.mean, 1.0 + 5e-7, 1e-12);
  EXPECT_NEAR(found.variance * 12e12, 1.0, 1e-6);
  EXPECT_NEAR(found.log_probability, std::log(1e-6 * density(1.0)), 1e-6);
}

}  // namespace
}  // namespace lacuna
