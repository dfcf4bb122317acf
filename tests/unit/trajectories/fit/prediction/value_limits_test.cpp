// SPDX-License-Identifier: MIT
#include "trajectories/fit/prediction/value_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lacuna/core/statistics/interval.hpp"

namespace lacuna {
namespace {

constexpr double kReach = 1.6448536269514722;  // the 95 % quantile of a normal number

double below(double q) { return 0.5 * std::erfc(-q / std::numbers::sqrt2); }

TEST(RunLimits, AreSymmetricOrByTheSameFactor) {
  EXPECT_DOUBLE_EQ(run_limits(3.0, 0.5, 2.0, false)[0], 2.0);
  EXPECT_DOUBLE_EQ(run_limits(3.0, 0.5, 2.0, false)[1], 4.0);
  const auto factor = run_limits(3.0, 0.3, 2.0, true);
  EXPECT_NEAR(factor[1] / 3.0, std::exp(0.2), 1e-12);
  EXPECT_NEAR(factor[0] * factor[1], 9.0, 1e-12);
}

TEST(ValueLimits, VariancesAdd) {
  const auto constant = value_limits({.constant = 0.4}, 2.0, 0.3, kReach);
  EXPECT_NEAR(constant[1] - 2.0, kReach * 0.5, 1e-12);
  EXPECT_NEAR(2.0 - constant[0], kReach * 0.5, 1e-12);
  const NoiseLaw proportional{.form = NoiseForm::Proportional, .fraction = 0.2};
  EXPECT_NEAR(value_limits(proportional, 2.0, 0.3, kReach)[1] - 2.0, kReach * 0.5, 1e-9);
  const NoiseLaw poisson{.form = NoiseForm::Poisson, .constant = 0.08};
  EXPECT_NEAR(value_limits(poisson, 2.0, 0.3, kReach)[1] - 2.0, kReach * 0.5, 1e-9);
}

TEST(ValueLimits, OfLognormalNoiseAreThoseOfTheLogarithm) {
  const NoiseLaw law{.form = NoiseForm::LogNormal, .fraction = 0.4};
  const auto limits = value_limits(law, 2.0, 0.6, kReach);
  EXPECT_NEAR(std::log(limits[1] / 2.0), kReach * 0.5, 1e-12);
  EXPECT_NEAR(std::log(limits[0] / 2.0), -kReach * 0.5, 1e-12);
}

TEST(ValueLimits, OfStudentsNoiseHaveItsQuantile) {
  const NoiseLaw law{.form = NoiseForm::Student, .constant = 0.5, .freedom = 5.0};
  EXPECT_NEAR(value_limits(law, 2.0, 0.0, kReach)[1] - 2.0, 0.5 * student_quantile_95(5.0),
              1e-12);
}

TEST(ValueLimits, WhatIsBeyondALimitIsTheLimit) {
  const NoiseLaw law{.constant = 1.0, .below = 1.5, .above = 2.5};
  const auto limits = value_limits(law, 2.0, 0.0, kReach);
  EXPECT_EQ(limits[0], 1.5);
  EXPECT_EQ(limits[1], 2.5);
}

TEST(ValueLimits, OfTruncatedNoiseHaveFivePercentOfTheRecordedValuesBeyond) {
  const NoiseLaw law{.constant = 0.4, .below = 1.8, .above = 2.6, .truncated = true};
  const auto limits = value_limits(law, 2.0, 0.3, kReach);
  const auto share = [&](double value) {
    const double low = below((1.8 - 2.0) / 0.5), high = below((2.6 - 2.0) / 0.5);
    return (below((value - 2.0) / 0.5) - low) / (high - low);
  };
  EXPECT_NEAR(share(limits[0]), 0.05, 1e-6);
  EXPECT_NEAR(share(limits[1]), 0.95, 1e-6);
  const NoiseLaw logs{.form = NoiseForm::LogNormal, .fraction = 0.5, .below = 2.0,
                      .truncated = true};
  const auto of_logs = value_limits(logs, 2.0, 0.0, kReach);
  EXPECT_NEAR(2.0 * (1.0 - below(std::log(of_logs[1] / 2.0) / 0.5)), 0.05, 1e-6);
  EXPECT_GT(of_logs[0], 2.0);
}

}  // namespace
}  // namespace lacuna
