// SPDX-License-Identifier: MIT
#include "trajectories/smoother/censoring.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

/// Moments of a standard normal variable about -z of which only what lies above 0 is known, by
/// the trapezoidal rule: probability, mean and variance.
struct Moments {
  double probability = 0.0, mean = 0.0, variance = 0.0;

  explicit Moments(double z) {
    const double h = 1e-4;
    double sums[3] = {0.0, 0.0, 0.0};
    for (double x = 0.0; x < std::max(0.0, z) + 12.0; x += h) {
      const double w = (x == 0.0 ? 0.5 : 1.0) * h * std::exp(-0.5 * (x - z) * (x - z));
      sums[0] += w;
      sums[1] += w * x;
      sums[2] += w * x * x;
    }
    probability = sums[0] / std::sqrt(2.0 * M_PI);
    mean = sums[1] / sums[0];
    variance = sums[2] / sums[0] - mean * mean;
  }
};

TEST(Truncation, HasTheMomentsOfTheTruncatedNormal) {
  for (const double z : {-6.0, -2.0, -0.3, 0.0, 1.0, 4.0}) {
    const Truncation known(z);
    const Moments exact(z);
    EXPECT_NEAR(known.deviance, -2.0 * std::log(exact.probability), 1e-5) << z;
    EXPECT_NEAR(z + known.shift, exact.mean, 1e-5) << z;
    EXPECT_NEAR(1.0 - known.fraction, exact.variance, 1e-5) << z;
  }
}

TEST(Truncation, GoesOnSmoothlyFarBelow) {
  for (const double z : {-25.0, -1e3}) {
    const Truncation here(z * (1.0 - 1e-9)), there(z * (1.0 + 1e-9));
    EXPECT_NEAR(there.deviance / here.deviance, 1.0, 1e-7);
    EXPECT_NEAR(there.shift / here.shift, 1.0, 1e-6);
    EXPECT_NEAR(there.fraction / here.fraction, 1.0, 1e-4);
    EXPECT_LT(here.fraction, 1.0);
  }
}

TEST(Truncation, SaysNothingFarAbove) {
  const Truncation known(40.0);
  EXPECT_EQ(known.deviance, 0.0);
  EXPECT_NEAR(known.fraction, 0.0, 1e-300);
}

/// Moments between two ends by the trapezoidal rule.
Truncation integrated(double low, double high) {
  const int n = 200000;
  const double h = (high - low) / n, middle = 0.5 * (low + high);
  double sums[3] = {};
  for (int i = 0; i <= n; ++i) {
    const double x = low + i * h;
    const double w = (i == 0 || i == n ? 0.5 : 1.0) * h *
                     std::exp(-0.5 * (x * x - middle * middle));
    for (int k = 0; k < 3; ++k) sums[k] += w * std::pow(x, k);
  }
  Truncation exact(0.0);
  exact.deviance = -2.0 * std::log(sums[0]) + middle * middle + std::log(2.0 * M_PI);
  exact.shift = sums[1] / sums[0];
  exact.fraction = 1.0 - (sums[2] / sums[0] - exact.shift * exact.shift);
  return exact;
}

TEST(Truncation, BetweenTwoEndsHasTheMomentsOfTheTruncatedNormal) {
  for (const double low : {-30.0, -9.0, -1.0, -0.2, 0.0, 0.7, 6.0, 24.0, 40.0})
    for (const double width : {0.01, 0.5, 3.0}) {
      const Truncation known(low, low + width), exact = integrated(low, low + width);
      const double far = std::abs(low) > 20.0 ? 1e-2 : 1e-5;  // by a series there
      EXPECT_NEAR(known.deviance, exact.deviance, far * std::abs(exact.deviance) + 1e-5);
      EXPECT_NEAR(known.shift, exact.shift, far * std::max(1.0, std::abs(exact.shift)))
          << low << " " << width;
      EXPECT_NEAR(known.fraction, exact.fraction, far) << low << " " << width;
    }
}

TEST(Truncation, BetweenNarrowEndsIsTheVarianceOfRounding) {
  const double step = 0.1;
  const Truncation known(0.3 - 0.5 * step, 0.3 + 0.5 * step);
  EXPECT_NEAR(1.0 - known.fraction, step * step / 12.0, 1e-5);
}

}  // namespace
}  // namespace lacuna
