// SPDX-License-Identifier: MIT
#include "core/numerics/periodogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

TEST(Periodogram, IsTheSumThatDefinesIt) {
  Random random(3);
  for (const Index n : {12, 15}) {
    const Vector x = Vector::NullaryExpr(n, [&] { return random.normal(); });
    const Vector window = hann_window(n);
    const Vector power = periodogram(x, window);
    ASSERT_EQ(power.size(), n / 2 + 1);
    for (Index f = 0; f <= n / 2; ++f) {
      std::complex<double> sum = 0.0;
      for (Index i = 0; i < n; ++i)
        sum += window[i] * (x[i] - x.mean()) *
               std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(f * i) /
                                   static_cast<double>(n));
      const bool alone = f == 0 || 2 * f == n;
      EXPECT_NEAR(power[f], (alone ? 1.0 : 2.0) * std::norm(sum), 1e-12) << f << " of " << n;
    }
  }
}

TEST(Periodogram, HannsWindowRisesToOneAndSumsToHalfItsLength) {
  const Vector window = hann_window(64);
  EXPECT_NEAR(window.maxCoeff(), 1.0, 1e-3);
  EXPECT_NEAR(window.sum(), 32.0, 1e-12);
  EXPECT_NEAR((window - window.reverse()).norm(), 0.0, 1e-12);
  EXPECT_LT(window[0], 1e-3);
}

}  // namespace
}  // namespace lacuna
