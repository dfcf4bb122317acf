// SPDX-License-Identifier: MIT
#include "core/numerics/serial_correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

/// r_i = memory r_(i-1) + white noise; rho_l = memory^l.
Vector first_order_series(double memory, Index n) {
  Random random(3);
  Vector series(n);
  double value = 0.0;
  for (double& entry : series) entry = value = memory * value + random.normal();
  return series;
}

TEST(SerialCorrelation, WhiteNoiseHasNone) {
  const SerialCorrelation found = serial_correlation(first_order_series(0.0, 20000));
  EXPECT_NEAR(found.time, 1.0, 0.01);
  EXPECT_EQ(found.reach, 5);
}

TEST(SerialCorrelation, ChanceIsNotCountedAsCorrelation) {
  // Squares of chance add 5 / 100 to the sum of a series of 100; without them it scatters by
  // sqrt(5 * 2) / 100 around 0, of which the half above counts, twice.
  Random random(8);
  double sum = 0.0;
  for (int draw = 0; draw < 400; ++draw) {
    Vector series(100);
    for (double& entry : series) entry = random.normal();
    sum += serial_correlation(series).time;
  }
  EXPECT_NEAR(sum / 400.0,
              1.0 + 2.0 * std::sqrt(10.0) / 100.0 / std::sqrt(2.0 * std::numbers::pi), 0.03);
}

TEST(SerialCorrelation, SumsTheSquaresOfAFirstOrderSeries) {
  const double memory = 0.9;
  const double expected = (1.0 + memory * memory) / (1.0 - memory * memory);
  const SerialCorrelation found = serial_correlation(first_order_series(memory, 200000));
  EXPECT_NEAR(found.time, expected, 0.1 * expected);
  EXPECT_NEAR(static_cast<double>(found.reach), 5.0 * expected, 0.6 * expected);
}

TEST(SerialCorrelation, EndsAtAQuarterOfTheSeries) {
  EXPECT_EQ(serial_correlation(Vector::Ones(100)).reach, 25);
  EXPECT_EQ(serial_correlation(Vector::Zero(100)).time, 1.0);
  EXPECT_EQ(serial_correlation(Vector()).reach, 0);
}

}  // namespace
}  // namespace lacuna
