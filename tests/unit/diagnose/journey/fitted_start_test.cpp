// SPDX-License-Identifier: MIT
#include "diagnose/journey/fitted_start.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "support/driven_oscillator.hpp"
#include "support/grey_box.hpp"

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

TEST(FittedStart, KeepsOneOfTheNumbersThatAreKnownOnlyTogether) {
  const std::string text =
      "input u hold linear\ndp/dt = -0.5*p + 0.4*u\ndq/dt = 0.6*p - 0.8*q\n";
  const OdeModel truth = parse_ode(text + "y = q\n", "t.ode"), nominal = parse_ode(text, "n.ode");
  Dataset columns =
      support::grey_box_columns(truth, {.start = Vector{{1.0, 1.0}}, .noise = 0.002});
  columns.states[0].name = "q";
  const Dataset data = model_view(nominal, columns, FiniteDifferences{});
  std::vector<Equation> equations = nominal.equations();
  for (Equation& equation : equations)
    for (WeightedTerm& term : equation) term.coefficient *= 1.3;
  const OdeModel off = nominal.with_equations(equations);
  const auto start = fitted_start(off, off, data, analyse_noise(data), RunContext{});
  ASSERT_TRUE(start);
  const double into = start->coefficient(0, "u"), through = start->coefficient(1, "p");
  EXPECT_NEAR(into * through, 0.24, 0.02) << "they are known as a product";
  EXPECT_TRUE(into == off.coefficient(0, "u") || through == off.coefficient(1, "p"));
}

TEST(FittedStart, IsNoneWhereThereIsNoTime) {
  const Dataset data = support::hidden_record(support::nothing, 0.01);
  const OdeModel nominal = off_by(1.6);
  RunContext late;
  late.deadline = std::chrono::steady_clock::now();
  EXPECT_FALSE(fitted_start(nominal, nominal, data, analyse_noise(data), late));
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
