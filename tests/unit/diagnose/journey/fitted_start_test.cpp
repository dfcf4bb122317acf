// SPDX-License-Identifier: MIT
#include "diagnose/journey/fitted_start.hpp"

#include <gtest/gtest.h>

#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

/// The oscillator with every coefficient of dv/dt a factor off.
OdeModel off_by(double factor) {
  std::vector<Equation> equations = support::oscillator().equations();
  for (WeightedTerm& term : equations[1]) term.coefficient *= factor;
  return support::oscillator().with_equations(std::move(equations));
}

TEST(FittedStart, HasTheCoefficientsOfTheRecord) {
  const Dataset data = support::hidden_record(support::nothing, 0.01);
  const OdeModel nominal = off_by(1.6);
  const auto start = fitted_start(nominal, nominal, data, analyse_noise(data), RunContext{});
  ASSERT_TRUE(start);
  EXPECT_NEAR(start->coefficient(1, "q"), -4.0, 0.02);
  EXPECT_NEAR(start->coefficient(1, "v"), -0.2, 0.01);
  EXPECT_EQ(start->coefficient(0, "v"), 1.0);
}

TEST(FittedStart, IsNoneWhereNoRunIsFinite) {
  const OdeModel oscillator = support::oscillator();
  const OdeModel wild = oscillator.with_term(
      1, {.term = Term::parse("sqrt(-1-q^2)", oscillator.variables()), .coefficient = 1.0});
  const Dataset data = support::hidden_record(support::nothing, 0.01);
  EXPECT_FALSE(fitted_start(wild, wild, data, analyse_noise(data), RunContext{}));
}

}  // namespace
}  // namespace lacuna
