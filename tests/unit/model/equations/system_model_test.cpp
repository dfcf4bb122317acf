// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/system_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using testing::expect_error;

constexpr const char* kTank = R"(input u
param k = 0.05 [1/s] in 0..1
param g = 2 fixed
param c = 0.7
dx/dt = -k*sqrt(x) + g*u + 3*x/(c+x) - x
dp/dt = q
dq/dt = -k*p*2
y = g*abs(x)+k [V]
initial x = 1 deviation 0.5
initial q = 0 fixed
)";

const WeightedTerm& summand(const OdeModel& model, Index equation, std::size_t i) {
  return model.equations()[static_cast<std::size_t>(equation)][i];
}

TEST(SystemModel, NumbersBecomeCoefficients) {
  const OdeModel model = parse_ode(kTank, "m.ode");
  EXPECT_EQ(model.inputs().size(), 1u);
  EXPECT_EQ(model.coefficient(0, "sqrt(x)"), -0.05);
  EXPECT_EQ(model.coefficient(0, "u"), 2.0);
  EXPECT_EQ(model.coefficient(0, "x/(0.7+x)"), 3.0);
  EXPECT_EQ(model.coefficient(2, "p"), -0.1);
  EXPECT_EQ(model.outputs()[0].formula.to_string(), "2*abs(x)+0.05");
  EXPECT_EQ(model.initial()[0]->deviation, 0.5);
  EXPECT_TRUE(model.initial()[2]->fixed);
  EXPECT_FALSE(model.initial()[1].has_value());
}

TEST(SystemModel, WhatIsKnownStaysFixed) {
  const OdeModel model = parse_ode(kTank, "m.ode");
  EXPECT_FALSE(summand(model, 0, 0).fixed) << "k is free";
  EXPECT_TRUE(summand(model, 0, 1).fixed) << "g is fixed";
  EXPECT_FALSE(summand(model, 0, 2).fixed) << "3 is a number";
  EXPECT_TRUE(summand(model, 0, 3).fixed) << "no number in front of x";
}

TEST(SystemModel, FreeNumbersAreThoseThatGiveASizeOnce) {
  const ParametrisedModel model = parse_ode_system(kTank, "m.ode").parametrised();
  EXPECT_THAT(model.names(), ElementsAre("x: x/(c+x)", "k", "c"));
  EXPECT_EQ(model.values(), (Vector(3) << 3.0, 0.05, 0.7).finished());
  EXPECT_EQ(model.shapes()[0].lower, 0.0);
  EXPECT_EQ(model.shapes()[0].upper, 1.0);
  const OdeModel at = model.with_values((Vector(3) << 4.0, 0.5, 0.25).finished()).model();
  EXPECT_EQ(at.coefficient(0, "x/(0.25+x)"), 4.0);
  EXPECT_EQ(at.outputs()[0].formula.to_string(), "2*abs(x)+0.5");
  EXPECT_EQ(at.initial()[0]->value, 1.0);
}

TEST(SystemModel, TheRatesAreThoseOfTheSymbols) {
  const SystemModel system = parse_ode_system(kTank, "m.ode");
  CompiledModel plain = system.model().compile(), symbolic = system.symbolic().compile();
  const double x[] = {1.7, 0.3, -0.2}, u[] = {0.4, 0.05, 2.0, 0.7};
  double a[3], b[3];
  plain.evaluate(0.0, x, u, nullptr, a);
  symbolic.evaluate(0.0, x, u, nullptr, b);
  const double by_hand = -0.05 * std::sqrt(1.7) + 0.8 + 5.1 / 2.4 - 1.7;
  EXPECT_NEAR(a[0], by_hand, 1e-14);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-14);
}

TEST(SystemModel, EqualTermsAreJoined) {
  const OdeModel model = parse_ode("param a = 2\nparam b = 3 fixed\ndx/dt = -a*x + x/b", "m");
  ASSERT_EQ(model.equations()[0].size(), 1u);
  EXPECT_NEAR(model.coefficient(0, "x"), -2.0 + 1.0 / 3.0, 1e-15);
  EXPECT_FALSE(summand(model, 0, 0).fixed);
}

TEST(SystemModel, ADelayCannotBeFree) {
  const SystemModel system = parse_ode_system("param T = 2\ndx/dt = -3*delay(x,T)", "m");
  EXPECT_EQ(system.model().coefficient(0, "delay(x,2)"), -3.0);
  expect_error<ModelError>([&] { system.parametrised(); }, "term delay(x,T)", "delay", "fixed");
}

TEST(SystemModel, RefusesWhatDoesNotFit) {
  const OdeModel model({{"x", ""}}, {{"k", ""}}, {{}});
  EXPECT_NO_THROW(SystemModel(model, {{"k", 1.0}}));
  expect_error<ModelError>(
      [&] {
        SystemModel(model, {{"j", 1.0}});
      },
      "model", "parameters", "last inputs");
  EXPECT_EQ(range_problem({.name = "k", .value = 2.0, .min = 3.0, .max = 1.0}),
            "its range 3..1 is upside down");
  EXPECT_EQ(range_problem({.name = "k", .value = 2.0, .min = 3.0}),
            "its value 2 is not in its range 3..");
  EXPECT_EQ(range_problem({.name = "k", .value = 2.0, .min = 2.0, .max = 2.0}), "");
  expect_error<ModelError>([&] { SystemModel(model, {{.name = "k", .value = 2, .max = 1.0}}); },
                           "parameter k", "not in its range", "range");
}

}  // namespace
}  // namespace lacuna
