// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/library_rates.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

/// 1, x, x*y, sin(x), delay(y, 0.5) over x, y, u.
TermLibrary library(bool delayed) {
  TermLibrary library{{{"x", "y"}, {"u"}}, {}};
  for (const char* text : {"1", "x", "x*y", "sin(x)"})
    library.terms.push_back(Term::parse(text, library.variables));
  if (delayed) library.terms.push_back(Term::parse("delay(y,0.5)*x", library.variables));
  return library;
}

/// x, y, u, t and, with delay, y half a unit ago.
Matrix points(bool delayed) {
  Matrix slots = Matrix::Random(4, delayed ? 5 : 4);
  slots.col(3).setLinSpaced(0.0, 1.0);
  return slots;
}

TEST(LibraryRates, ThetaHasTheChosenTerms) {
  LibraryRates rates(library(false), {{1, 3}, {}}, false);
  const Matrix slots = points(false);
  rates.evaluate(slots);
  ASSERT_EQ(rates.theta().rows(), 2);
  for (Index i = 0; i < 4; ++i) {
    EXPECT_EQ(rates.theta()(0, i), slots(i, 0));
    EXPECT_DOUBLE_EQ(rates.theta()(1, i), std::sin(slots(i, 0)));
  }
}

TEST(LibraryRates, JacobiansAreThoseOfTheWeightedTerms) {
  LibraryRates rates(library(false), {{0}, {1, 2, 3}}, false);
  const Matrix slots = points(false);
  Matrix h(2, 4), jacobians;
  h << 0.0, 2.0, 0.0, 1.5, 5.0, 0.0, -3.0, 0.0;
  rates.evaluate(slots);
  rates.jacobians(h, jacobians);
  ASSERT_EQ(jacobians.rows(), 4);
  for (Index i = 0; i < 4; ++i) {
    const double x = slots(i, 0), y = slots(i, 1);
    EXPECT_NEAR(jacobians(0, i), 2.0 + 1.5 * std::cos(x), 1e-15);
    EXPECT_NEAR(jacobians(1, i), -3.0 * y, 1e-15);
    EXPECT_EQ(jacobians(2, i), 0.0);
    EXPECT_NEAR(jacobians(3, i), -3.0 * x, 1e-15);
  }
}

TEST(LibraryRates, DelayedVariablesHaveTheSlotsOfTheWholeLibrary) {
  LibraryRates rates(library(true), {{3, 4}, {4}}, true);
  const Matrix slots = points(true);
  Matrix h = Matrix::Zero(2, 5), jacobians;
  h(1, 4) = 2.0;
  rates.evaluate(slots);
  rates.jacobians(h, jacobians);
  for (Index i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(rates.theta()(1, i), slots(i, 0) * slots(i, 4));
    EXPECT_NEAR(jacobians(1, i), 2.0 * slots(i, 4), 1e-15) << "the delayed value is held";
  }
}

}  // namespace
}  // namespace lacuna
