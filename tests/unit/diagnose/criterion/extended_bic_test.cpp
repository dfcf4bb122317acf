// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/criterion/extended_bic.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

TEST(ExtendedBic, PaysLogOfTheSamplesForAParameter) {
  // 3 parameters, e^2 samples.
  EXPECT_NEAR(ExtendedBic{}.penalty({0.0, 3.0, std::exp(2.0), 0.0}), 6.0, 1e-12);
}

TEST(ExtendedBic, PaysForBeingTheBestOfMany) {
  // Two effects, each the best of e^3: 2 (3 + 3).
  EXPECT_NEAR(ExtendedBic{}.penalty({0.0, 0.0, 100.0, 6.0}), 12.0, 1e-12);
  EXPECT_DOUBLE_EQ(ExtendedBic({.choice = 0.0}).penalty({0.0, 0.0, 100.0, 6.0}), 0.0);
}

TEST(ExtendedBic, IsTheLaplaceApproximationOfTheEvidenceOfAGaussianMean) {
  // n observations of unit variance with a mean that has a unit-information prior: the exact
  // evidence differs from exp(-BIC/2) by a bounded factor, whatever n.
  const auto exact = [](double n, double mean) {
    const double with = -0.5 * n * mean * mean / (1.0 + n) - 0.5 * std::log1p(n);
    const double without = -0.5 * n * mean * mean;
    return with - without;  // log evidence ratio, prior N(0, 1)
  };
  const auto approximate = [](double n, double mean) {
    const ExtendedBic bic;
    return 0.5 * (bic.value({n * mean * mean, 0.0, n, 0.0}) - bic.value({0.0, 1.0, n, 0.0}));
  };
  for (const double n : {100.0, 1e4, 1e6})
    EXPECT_NEAR(exact(n, 0.3), approximate(n, 0.3), 0.1) << n;
}

TEST(ExtendedBic, RefusesAChoiceOutOfItsRange) {
  EXPECT_THROW(ExtendedBic({.choice = 1.5}), ConfigError);
}

}  // namespace
}  // namespace lacuna
