// SPDX-License-Identifier: MIT
#include "lacuna/core/numerics/serial_correlation.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/random.hpp"

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
