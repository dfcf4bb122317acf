// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "identify/hidden_state/polynomial.hpp"
#include "identify/hidden_state/sparse_coordinates.hpp"

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

void add(Polynomial& p, Polynomial::Exponents exponents, double value, double error = 0.0) {
  p.add(exponents, {value, error * error});
}

/// Lorenz' system in x, z and w = dx/dt, as it follows by hand from y = x + w / 10:
/// w' = 270 x - 11 w - 10 x z, z' = x^2 + x w / 10 - 8/3 z.
HiddenStateModel lorenz(double error) {
  HiddenStateModel model{std::vector<Polynomial>(3), 3, 2};  // x, z, w
  add(model.rates[0], {0, 0, 1}, 1.0);
  add(model.rates[1], {2, 0, 0}, 1.0 + error, error);
  add(model.rates[1], {1, 0, 1}, 0.1);
  add(model.rates[1], {0, 1, 0}, -8.0 / 3.0);
  add(model.rates[2], {1, 0, 0}, 270.0);
  add(model.rates[2], {0, 0, 1}, -11.0);
  add(model.rates[2], {1, 1, 0}, -10.0);
  return model;
}

TEST(SparseCoordinates, FindWhatWasTakenTogether) {
  for (const double error : {0.0, 0.002}) {
    const HiddenStateModel found = in_sparse_coordinates(lorenz(error));
    // h = 10 y: x' = h - 10 x, z' = x h / 10 - 8/3 z, h' = 280 x - h - 10 x z.
    const auto tolerance = [&](double value) { return 1e-9 + 3.0 * error * std::abs(value); };
    ASSERT_EQ(found.rates[0].terms().size(), 2U);
    EXPECT_NEAR(found.rates[0].terms().at({1, 0, 0}).value, -10.0, tolerance(10.0));
    ASSERT_EQ(found.rates[1].terms().size(), 2U);
    EXPECT_NEAR(found.rates[1].terms().at({1, 0, 1}).value, 0.1, 1e-12);
    ASSERT_EQ(found.rates[2].terms().size(), 3U);
    EXPECT_NEAR(found.rates[2].terms().at({1, 0, 0}).value, 280.0, tolerance(280.0));
    EXPECT_NEAR(found.rates[2].terms().at({0, 0, 1}).value, -1.0, tolerance(20.0));
    EXPECT_EQ(complexity(found), 16);
  }
}

TEST(SparseCoordinates, TakesCubesOfMeasuredStates) {
  // x' = h - x^3, y' = h, h' = -x: with w = x', y' = w + x^3 and w' = -x - 3 x^2 w.
  HiddenStateModel model{std::vector<Polynomial>(3), 3, 2};  // x, y, w
  add(model.rates[0], {0, 0, 1}, 1.0);
  add(model.rates[1], {0, 0, 1}, 1.0);
  add(model.rates[1], {3, 0, 0}, 1.0);
  add(model.rates[2], {1, 0, 0}, -1.0);
  add(model.rates[2], {2, 0, 1}, -3.0);
  const HiddenStateModel found = in_sparse_coordinates(model);
  ASSERT_EQ(found.rates[2].terms().size(), 1U);
  EXPECT_NEAR(found.rates[2].terms().at({1, 0, 0}).value, -1.0, 1e-9);
  EXPECT_NEAR(found.rates[0].terms().at({3, 0, 0}).value, -1.0, 1e-9);
  EXPECT_EQ(found.rates[1].terms().size(), 1U);
}

TEST(SparseCoordinates, LeavesWhatIsSimpleAlone) {
  HiddenStateModel model{std::vector<Polynomial>(2), 2, 1};  // a pendulum for small angles
  add(model.rates[0], {0, 1}, 1.0);
  add(model.rates[1], {1, 0}, -4.0);
  EXPECT_EQ(complexity(in_sparse_coordinates(model)), complexity(model));
}

TEST(SparseCoordinates, TermsThatAreNotKnownFromNothingGo) {
  HiddenStateModel model{std::vector<Polynomial>(1), 1, 0};
  add(model.rates[0], {1}, 0.5, 0.2);
  add(model.rates[0], {0}, 0.5, 0.1);
  const HiddenStateModel left = without_vanishing(model);
  ASSERT_EQ(left.rates[0].terms().size(), 1U);
  EXPECT_EQ(left.rates[0].terms().count({0}), 1U);
}

}  // namespace
}  // namespace lacuna
