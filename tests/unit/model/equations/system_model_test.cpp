// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/system_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/files/model_file.hpp"
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

const Variables kVariables{{"x", "y"}, {"u"}};

OdeModel model_of(const std::vector<std::vector<std::pair<double, std::string>>>& equations) {
  std::vector<Equation> built;
  for (const auto& equation : equations) {
    built.emplace_back();
    for (const auto& [coefficient, text] : equation)
      built.back().push_back({Term::parse(text, kVariables), coefficient});
  }
  return OdeModel({{"x", ""}, {"y", ""}}, {{"u", ""}}, std::move(built));
}

TEST(CompiledModel, AnEmptyEquationIsZero) {
  CompiledModel model = model_of({{}, {{0.0, "x"}}}).compile();
  const double x[2] = {3.0, 5.0};
  const double u = 0.0;
  double rate[2] = {9.0, 9.0};
  model.evaluate(0.0, x, &u, nullptr, rate);
  EXPECT_EQ(rate[0], 0.0);
  EXPECT_EQ(rate[1], 0.0);
  Matrix derivative = Matrix::Constant(2, 2, 9.0);
  model.jacobian(0.0, x, &u, nullptr, derivative);
  EXPECT_EQ(derivative, Matrix::Zero(2, 2));
}

TEST(CompiledModel, DelayedValuesComeInTheOrderOfDelays) {
  CompiledModel model =
      model_of({{{1.0, "delay(y,2)"}}, {{1.0, "x*delay(x,1)"}, {10.0, "delay(y,2)"}}})
          .compile();
  const std::vector<DelayedVariable> expected{{1, 2.0}, {0, 1.0}};
  EXPECT_EQ(model.delays(), expected);
  const double x[2] = {3.0, 5.0};
  const double u = 0.0;
  const double delayed[2] = {100.0, 7.0};
  double rate[2];
  model.evaluate(0.0, x, &u, delayed, rate);
  EXPECT_EQ(rate[0], 100.0);
  EXPECT_EQ(rate[1], 21.0 + 1000.0);
  Matrix derivative(2, 2);
  model.jacobian(0.0, x, &u, delayed, derivative);
  EXPECT_EQ(derivative, (Matrix(2, 2) << 0.0, 0.0, 7.0, 0.0).finished());
}

TEST(CompiledModel, JacobianAgreesWithFiniteDifferences) {
  CompiledModel model =
      model_of({{{1.3, "x^2*y"}, {-0.4, "sin(x*y)"}, {2.0, "u*x"}},
                {{0.7, "x/y"}, {1.1, "exp(-y)"}, {-2.0, "tanh(x/0.3)"}, {1.0, "t*y"}}})
          .compile();
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const double x[2] = {random.uniform(0.5, 2.0), random.uniform(0.5, 2.0)};
    const double u = random.normal();
    Matrix derivative(2, 2);
    model.jacobian(0.7, x, &u, nullptr, derivative);
    for (Index j = 0; j < 2; ++j) {
      constexpr double kStep = 1e-6;
      double above[2] = {x[0], x[1]};
      double below[2] = {x[0], x[1]};
      above[j] += kStep;
      below[j] -= kStep;
      Vector high(2);
      Vector low(2);
      model.evaluate(0.7, above, &u, nullptr, high.data());
      model.evaluate(0.7, below, &u, nullptr, low.data());
      EXPECT_LT((derivative.col(j) - (high - low) / (2.0 * kStep)).norm(), 1e-7);
    }
  }
}

TEST(CompiledModel, JacobianFitsIntoABlockOfALargerMatrix) {
  CompiledModel model = model_of({{{2.0, "y"}}, {{3.0, "x"}}}).compile();
  const double x[2] = {1.0, 1.0};
  const double u = 0.0;
  Matrix large = Matrix::Zero(4, 4);
  model.jacobian(0.0, x, &u, nullptr, large.block(1, 1, 2, 2));
  EXPECT_EQ(large(1, 2), 2.0);
  EXPECT_EQ(large(2, 1), 3.0);
  EXPECT_EQ(large.sum(), 5.0);
  Matrix wrong(3, 2);
  EXPECT_THROW(model.jacobian(0.0, x, &u, nullptr, wrong), ArgumentError);
}

TEST(CompiledModel, CopiesAreIndependentOfTheModelAndOfEachOther) {
  CompiledModel first = model_of({{{2.0, "y"}}, {{3.0, "x^2"}}}).compile();
  CompiledModel second = first;
  const double x[2] = {1.0, 4.0};
  const double u = 0.0;
  double a[2];
  double b[2];
  first.evaluate(0.0, x, &u, nullptr, a);
  Matrix derivative(2, 2);
  first.jacobian(0.0, x, &u, nullptr, derivative);
  second.evaluate(0.0, x, &u, nullptr, b);
  EXPECT_EQ(a[0], b[0]);
  EXPECT_EQ(a[1], b[1]);
  EXPECT_EQ(derivative(1, 0), 6.0);
}

TEST(CompiledModel, AJacobianOfManyStatesHasFewEntries) {
  constexpr Index kStates = 3000;
  std::vector<Quantity> states;
  for (Index i = 0; i < kStates; ++i) states.push_back({"x" + std::to_string(i), ""});
  const VariableIndex index({names_of(states), {}});
  std::vector<Equation> equations;
  for (Index i = 0; i < kStates; ++i) {
    const std::string next = "x" + std::to_string((i + 1) % kStates);
    equations.push_back({{Term(parse_expression(next + "^2"), index), 0.5}});
  }
  CompiledModel model = OdeModel(states, {}, equations).compile();
  const Vector x = Vector::LinSpaced(kStates, 1.0, 2.0);
  Matrix jacobian = Matrix::Constant(kStates, kStates, 7.0);
  model.jacobian(0.0, x.data(), nullptr, nullptr, jacobian);
  for (Index i = 0; i < kStates; ++i) {
    const Index next = (i + 1) % kStates;
    ASSERT_EQ(jacobian(i, next), x[next]);
    jacobian(i, next) = 0.0;
  }
  EXPECT_TRUE(jacobian.isZero(0.0));
}

}  // namespace
}  // namespace lacuna
