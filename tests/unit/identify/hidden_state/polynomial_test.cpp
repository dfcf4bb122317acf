// SPDX-License-Identifier: MIT
#include "identify/hidden_state/polynomial.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

/// 3 x^2 y - 2 y + 1 with standard errors 0.1, 0.2, 0.
Polynomial example() {
  Polynomial p;
  p.add({2, 1}, {3.0, 0.01});
  p.add({0, 1}, {-2.0, 0.04});
  p.add({0, 0}, {1.0, 0.0});
  return p;
}

double value(const Polynomial& p, double x, double y) {
  double sum = 0.0;
  for (const auto& [exponents, coefficient] : p.terms())
    sum += coefficient.value * std::pow(x, exponents[0]) * std::pow(y, exponents[1]);
  return sum;
}

TEST(Polynomial, OperationsAreThoseOfItsValues) {
  const Polynomial p = example();
  Polynomial q;
  q.add({1, 0}, {1.0, 0.0});
  q.add({0, 2}, {0.5, 0.0});
  const double x = 0.7, y = -1.3, at_q = x + 0.5 * y * y;
  const double at_p = 3.0 * x * x * y - 2.0 * y + 1.0;
  EXPECT_NEAR(value(p, x, y), at_p, 1e-14);
  EXPECT_NEAR(value(sum(p, q), x, y), at_p + at_q, 1e-14);
  EXPECT_NEAR(value(scaled(p, -2.5), x, y), -2.5 * at_p, 1e-14);
  EXPECT_NEAR(value(product(p, q), x, y), at_p * at_q, 1e-14);
  EXPECT_NEAR(value(derivative(p, 0), x, y), 6.0 * x * y, 1e-14);
  EXPECT_NEAR(value(derivative(p, 1), x, y), 3.0 * x * x - 2.0, 1e-14);
  EXPECT_NEAR(value(substituted(p, 0, q), x, y), 3.0 * at_q * at_q * y - 2.0 * y + 1.0, 1e-13);
  EXPECT_NEAR(value(evaluated(p, 1, 4.0), x, 99.0), 12.0 * x * x - 7.0, 1e-13);
}

TEST(Polynomial, VariancesGrowWithTheSquareOfFactors) {
  EXPECT_DOUBLE_EQ(scaled(example(), 3.0).terms().at({2, 1}).variance, 0.09);
  EXPECT_DOUBLE_EQ(evaluated(example(), 1, 2.0).terms().at({2, 0}).variance, 0.04);
  EXPECT_DOUBLE_EQ(evaluated(example(), 1, 2.0).terms().at({0, 0}).variance, 0.16);
  EXPECT_DOUBLE_EQ(derivative(example(), 0).terms().at({1, 1}).variance, 0.04);
  EXPECT_DOUBLE_EQ(sum(example(), example()).terms().at({0, 1}).variance, 0.08);
}

}  // namespace
}  // namespace lacuna
