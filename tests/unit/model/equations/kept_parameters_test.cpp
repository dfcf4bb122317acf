// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "lacuna/model/equations/system_model.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

constexpr const char* kMotor = R"(time s
input u [V]
state i [A]
state w [rad/s]
param R = 1.7 +- 0.1 [ohm] in 0.1..10
param L = 0.03 [H] in 0.001..1
param K = 0.21 */ 1.2 [V s/rad]
param J = 0.004 [kg m^2] fixed
di/dt = (u - R*i - K*w)/L
dw/dt = K*i/J - 0.3*w
y = R*i [V]
initial w = 2 fixed
)";

/// The model with a coefficient multiplied.
OdeModel scaled(const OdeModel& model, Index equation, const std::string& term, double factor) {
  std::vector<Equation> equations = model.equations();
  bool found = false;
  for (WeightedTerm& summand : equations[static_cast<std::size_t>(equation)])
    if (summand.term.name() == term) {
      summand.coefficient *= factor;
      found = true;
    }
  EXPECT_TRUE(found) << term;
  return model.with_equations(std::move(equations));
}

OdeModel with_added(const OdeModel& model, Index equation, const std::string& term,
                    double coefficient) {
  return model.with_term(equation, {Term::parse(term, model.variables()), coefficient});
}

/// Rates of a model at a random instant, states and inputs.
Vector rates_of(const OdeModel& model, std::uint64_t seed) {
  Random random(seed);
  Vector x(model.dimension()), u(static_cast<Index>(model.inputs().size())), f(x.size());
  for (double& value : x) value = random.normal();
  for (double& value : u) value = random.normal();
  model.compile().evaluate(0.7, x.data(), u.data(), nullptr, f.data());
  return f;
}

/// Written in parameters, as text and as JSON read back, it has the rates that were estimated.
void expect_same_rates(const SystemModel& written, const OdeModel& estimated) {
  const SystemModel text = parse_ode_system(format_ode(written), "better.ode");
  const SystemModel json = parse_system(format_model(written), "better.json");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Vector expected = rates_of(estimated, seed);
    for (const SystemModel* one : {&written, &text, &json})
      EXPECT_LT((rates_of(one->model(), seed) - expected).norm(), 1e-11 * expected.norm())
          << format_ode(*one);
  }
}

TEST(KeptParameters, EstimatedOverGivenStandsInFrontOfWhatWasWritten) {
  const SystemModel given = parse_ode_system(kMotor, "motor.ode");
  OdeModel estimated = scaled(given.model(), 0, "u", 1.25);
  estimated = scaled(estimated, 1, "w", 0.5);
  estimated = with_added(estimated, 1, "sign(w)", -12.5);
  const SystemModel written = with_parameters_of(given, estimated);
  const std::string text = format_ode(written);
  EXPECT_THAT(text, HasSubstr("di/dt = 1.25*u*L^-1 - i*R*L^-1 - w*L^-1*K\n"));
  EXPECT_THAT(text, HasSubstr("dw/dt = i*K*J^-1 - 0.15*w - 12.5*sign(w)\n"));
  EXPECT_THAT(text, HasSubstr("y = R*i [V]\n"));
  EXPECT_THAT(text, HasSubstr("initial w = 2 fixed\n"));
  EXPECT_THAT(text, HasSubstr("param R = 1.7 +- 0.1 [ohm] in 0.1..10\n"));
  EXPECT_THAT(text, HasSubstr("param K = 0.21 */ 1.2 [V s/rad]\n"));
  EXPECT_THAT(text, HasSubstr("param J = 0.004 [kg m^2] fixed\n"));
  expect_same_rates(written, estimated);
}

TEST(KeptParameters, ABracketOfWhichNothingMovedStays) {
  const SystemModel given = parse_ode_system(kMotor, "motor.ode");
  const SystemModel same = with_parameters_of(given, given.model());
  EXPECT_EQ(format_ode(same), format_ode(given));
  OdeModel doubled = given.model();
  for (const char* term : {"u", "i", "w"}) doubled = scaled(doubled, 0, term, 2.0);
  const SystemModel written = with_parameters_of(given, doubled);
  EXPECT_THAT(format_ode(written), HasSubstr("di/dt = 2*(u-R*i-K*w)/L\n"));
  expect_same_rates(written, doubled);
}

TEST(KeptParameters, ParametersAreWhatAFitEstimates) {
  const SystemModel given = parse_ode_system(kMotor, "motor.ode");
  const OdeModel estimated = with_added(scaled(given.model(), 0, "i", 1.25), 1, "w^2", 0.01);
  const SystemModel text =
      parse_ode_system(format_ode(with_parameters_of(given, estimated)), "better.ode");
  EXPECT_THAT(text.parametrised().names(),
              ::testing::ElementsAre("w: w", "w: w^2", "R", "L", "K"));
}

TEST(KeptParameters, ErrorsAreThoseOfTheRatio) {
  const SystemModel given = parse_ode_system("param k = 4\ndx/dt = -k*x\n", "m.ode");
  const OdeModel numbers = given.model();
  const OdeModel estimated = numbers.with_equations({{{.term = numbers.equations()[0][0].term,
                                                       .coefficient = -5.0,
                                                       .standard_error = 0.2,
                                                       .ci95 = std::array{-5.4, -4.6}}}});
  const WeightedTerm ratio = with_parameters_of(given, estimated).symbolic().equations()[0][0];
  EXPECT_EQ(ratio.term.name(), "x*k");
  EXPECT_DOUBLE_EQ(ratio.coefficient, -1.25);
  EXPECT_DOUBLE_EQ(ratio.standard_error.value(), 0.05);
  EXPECT_DOUBLE_EQ(ratio.ci95.value()[0], -1.35);
  EXPECT_DOUBLE_EQ(ratio.ci95.value()[1], -1.15);
}

TEST(KeptParameters, TermsOfParametersThatAreOneInNumbersMoveTogether) {
  const SystemModel given = parse_ode_system(
      "param a = 0.4\nparam b = 0.2\ndx/dt = -a*x - b*x + a*x*(1-x/b) + exp(-a*x)\n", "m.ode");
  const OdeModel estimated = scaled(scaled(given.model(), 0, "x", 1.5), 0, "exp(-0.4*x)", 0.75);
  const SystemModel written = with_parameters_of(given, estimated);
  EXPECT_THAT(format_ode(written), HasSubstr("0.75*exp(-a*x)"));
  expect_same_rates(written, estimated);
}

TEST(KeptParameters, WhatNoRatioGivesIsWrittenInNumbers) {
  // 0.1 + 0.2 is not quite 0.3: what is left of the two terms is rounding.
  const SystemModel given = parse_ode_system(
      "param a = 0.30000000000000004\nparam b = 0.3\nparam c = 0\n"
      "dx/dt = a*x - b*x - c*x^3 - 2*a\ndy/dt = -b*y\n",
      "m.ode");
  std::vector<Equation> equations = given.model().equations();
  equations[0] = {{Term::parse("x", given.model().variables()), 0.8},
                  {Term::parse("1", given.model().variables()), -0.7}};
  equations[1][0].coefficient = -0.6;
  const OdeModel estimated = given.model().with_equations(std::move(equations));
  const SystemModel written = with_parameters_of(given, estimated);
  EXPECT_THAT(format_ode(written), HasSubstr("dx/dt = 0.8*x - 0.7\n"));
  EXPECT_THAT(format_ode(written), HasSubstr("dy/dt = -2*y*b\n"));
  expect_same_rates(written, estimated);
}

TEST(KeptParameters, TermsThatAreGoneAreLeftOutAndParametersOf0Stay) {
  const SystemModel given = parse_ode_system(
      "input u\nparam k = 2\nparam c = 0\ndx/dt = k*(u - x - c*x^3)\n", "m.ode");
  const OdeModel numbers = given.model();
  std::vector<Equation> equations = numbers.equations();
  std::erase_if(equations[0], [](const WeightedTerm& one) { return one.term.name() == "u"; });
  equations[0].push_back({Term::parse("delay(u,0.2)", numbers.variables()), 2.5});
  const OdeModel estimated = numbers.with_equations(std::move(equations));
  const std::string text = format_ode(with_parameters_of(given, estimated));
  EXPECT_THAT(text, HasSubstr("dx/dt = -x*k - x^3*k*c + 2.5*delay(u,0.2)\n"));
}

TEST(KeptParameters, StatesOfEffectsAreAddedButForNamesOfParameters) {
  const SystemModel given =
      parse_ode_system("input u\nparam z = 2\ndx/dt = -z*x + u\n", "m.ode");
  const auto with_state = [](const std::string& name) {
    const Variables variables{.states = {"x", name}, .inputs = {"u"}};
    return OdeModel({{"x", ""}, {name, ""}}, {{"u", ""}},
                    {{{Term::parse("x", variables), -2.5},
                      {Term::parse("u", variables), 1.0},
                      {Term::parse(name, variables), 0.3}},
                     {{Term::parse("x-" + name, variables), 4.0}}});
  };
  const SystemModel store = with_parameters_of(given, with_state("m"));
  EXPECT_THAT(format_ode(store), HasSubstr("dx/dt = -1.25*x*z + u + 0.3*m\n"));
  expect_same_rates(store, with_state("m"));
  const SystemModel taken = with_parameters_of(given, with_state("z"));
  EXPECT_TRUE(taken.parameters().empty());
  expect_same_rates(taken, with_state("z"));
}

}  // namespace
}  // namespace lacuna
