// SPDX-License-Identifier: MIT
#include "core/numerics/significance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

TEST(Significance, TailOfChiSquaredIsThatOfTheTables) {
  EXPECT_NEAR(std::exp(log_chi_squared_tail(3.841459, 1.0)), 0.05, 1e-6);
  EXPECT_NEAR(std::exp(log_chi_squared_tail(11.344867, 3.0)), 0.01, 1e-6);
  EXPECT_NEAR(std::exp(log_chi_squared_tail(0.1, 2.0)), std::exp(-0.05), 1e-9);
  EXPECT_NEAR(log_chi_squared_tail(1e5, 2.0), -5e4, 1e-6);
}

TEST(Significance, OneCandidateKeepsItsSigma) {
  EXPECT_NEAR(sigma_of_gain(9.0, 1.0, 1.0), 3.0, 1e-6);
  EXPECT_NEAR(sigma_of_gain(2500.0, 1.0, 1.0), 50.0, 1e-6);
}

TEST(Significance, ManyCandidatesCost) {
  EXPECT_LT(sigma_of_gain(16.0, 1.0, 500.0), 2.4);
  EXPECT_EQ(sigma_of_gain(4.0, 1.0, 1000.0), 0.0);
  EXPECT_LT(sigma_of_gain(16.0, 3.0, 1.0), sigma_of_gain(16.0, 1.0, 1.0));
}

}  // namespace
}  // namespace lacuna
