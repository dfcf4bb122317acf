// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/expressions/expression.hpp"
#include "lacuna/model/expressions/program.hpp"
#include "model/expressions/unbound_delays.hpp"
#include "unit/model/expressions/random_expression.hpp"

namespace lacuna {
namespace {

std::string derivative_text(const std::string& formula) {
  return differentiate(parse_expression(formula), "x").to_string();
}

TEST(Differentiate, SimplifiesPlainly) {
  EXPECT_EQ(derivative_text("3"), "0");
  EXPECT_EQ(derivative_text("y*z"), "0");
  EXPECT_EQ(derivative_text("x"), "1");
  EXPECT_EQ(derivative_text("2*x"), "2");
  EXPECT_EQ(derivative_text("x*y"), "y");
  EXPECT_EQ(derivative_text("x^2"), "2*x");
  EXPECT_EQ(derivative_text("x^3*y"), "3*x^2*y");
  EXPECT_EQ(derivative_text("x^-1"), "-x^-2");
  EXPECT_EQ(derivative_text("-x*y"), "-y");
  EXPECT_EQ(derivative_text("x/y"), "1/y");
  EXPECT_EQ(derivative_text("sin(x)"), "cos(x)");
  EXPECT_EQ(derivative_text("cos(2*x)"), "-sin(2*x)*2");
  EXPECT_EQ(derivative_text("exp(x)"), "exp(x)");
  EXPECT_EQ(derivative_text("log(x)"), "1/x");
}

TEST(Differentiate, KinksTakeTheStatedBranch) {
  EXPECT_EQ(derivative_text("abs(x)"), "sign(x)");
  EXPECT_EQ(derivative_text("sign(x)"), "0");
  EXPECT_EQ(derivative_text("step(x)"), "0");
  EXPECT_EQ(derivative_text("max(x,y)"), "step(x-y)");
}

TEST(Differentiate, ADelayedVariableIsAnotherOne) {
  EXPECT_EQ(derivative_text("delay(x,1)"), "0");
  EXPECT_EQ(derivative_text("x*delay(x,1)"), "delay(x,1)");
}

/// Value and derivative at a point, delayed variables having the value 0.7.
class Point {
 public:
  Point(const Expression& e, std::vector<double> slots)
      : program_({&e, 1}, {{"x", "y", "th_1"}, {"_u"}}), slots_(std::move(slots)) {
    slots_.resize(static_cast<std::size_t>(program_.slots()), 0.7);
  }

  double at(double x) {
    slots_[0] = x;
    double result = 0.0;
    program_.evaluate(slots_.data(), &result, workspace_);
    return result;
  }

 private:
  Program program_;
  std::vector<double> slots_;
  Program::Workspace workspace_;
};

/// Error of the exact derivative against central differences with two steps; nothing where
/// these disagree (a kink, a pole, cancellation).
std::optional<double> derivative_error(const Expression& e, const std::vector<double>& slots) {
  Point value(e, slots);
  Point slope(differentiate(e, "x"), slots);
  const double x = slots[0];
  const auto central = [&](double h) {
    return (value.at(x + h) - value.at(x - h)) / (2.0 * h);
  };
  const double coarse = central(2e-4);
  const double fine = central(1e-4);
  const double extrapolated = fine + (fine - coarse) / 3.0;
  const double scale = std::max({1.0, std::abs(value.at(x)), std::abs(extrapolated)});
  if (!std::isfinite(scale) || scale > 1e6 || !(std::abs(fine - coarse) < 1e-5 * scale))
    return std::nullopt;
  return std::abs(slope.at(x) - extrapolated) / scale;
}

TEST(Differentiate, AgreesWithCentralDifferences) {
  Random random(77);
  int compared = 0;
  int singular = 0;  // such as 0^x, where 0*log(0) comes up
  for (int i = 0; i < 4000; ++i) {
    const Expression e = testing::random_expression(random, 1 + static_cast<int>(i % 4));
    std::vector<double> slots(5);
    for (double& slot : slots) slot = random.uniform(0.2, 1.4);
    const std::optional<double> error = derivative_error(e, slots);
    if (!error || e.variables().count("x") == 0) continue;
    if (std::isnan(*error) && ++singular > 0) continue;
    EXPECT_LT(*error, 1e-6) << e.to_string() << " at x = " << slots[0];
    ++compared;
  }
  EXPECT_GT(compared, 500);
  EXPECT_LT(singular, compared / 100);
}

TEST(Differentiate, TheDeepestFormulaHasADerivative) {
  for (const std::string step : {"x*", "x/", "x+"}) {
    std::string text;
    for (int i = 0; i < kMaxFormulaDepth; ++i) text += step;
    const Expression derivative = differentiate(parse_expression(text + "x"), "x");
    const Program program({&derivative, 1}, {{"x"}, {}});
    EXPECT_EQ(program.outputs(), 1);
  }
}

Expression parsed(const std::string& text) { return parse_expression(text); }

TEST(Substitute, PutsExpressionsInPlaceOfNamesAllAtOnce) {
  EXPECT_EQ(substitute(parsed("x*y+sin(x)"), {{"x", parsed("y-1")}, {"y", parsed("x^2")}}),
            parsed("(y-1)*x^2+sin(y-1)"));
  EXPECT_EQ(substitute(parsed("x*y"), {{"z", parsed("1")}}), parsed("x*y"));
}

TEST(Substitute, NumbersGiveWhatWouldHaveBeenWritten) {
  EXPECT_EQ(substitute(parsed("clip(x,-a,a)*1e5"), {{"a", Expression::number(0.3)}}),
            parsed("clip(x,-0.3,0.3)*1e5"));
  EXPECT_EQ(substitute(parsed("x-a"), {{"a", Expression::number(-1.5)}}), parsed("x-(-1.5)"));
}

TEST(Substitute, ADelayIsBoundByANumber) {
  const Expression late = parsed("delay(x,T)-x");
  EXPECT_EQ(late.variables(), (std::set<std::string>{"T", "x"}));
  EXPECT_EQ(substitute(late, {{"T", Expression::number(0.25)}}), parsed("delay(x,0.25)-x"));
  EXPECT_EQ(substitute(late, {{"T", Expression::number(0.0)}}), parsed("x-x"));
  EXPECT_EQ(substitute(late, {{"T", parsed("2*S")}}), parsed("delay(x,2*S)-x"));
  EXPECT_THROW(substitute(late, {{"T", Expression::number(-1.0)}}), ModelError);
}

TEST(Substitute, WhatStandsInADelayIsDelayed) {
  EXPECT_EQ(substitute(parsed("delay(x,0.5)"), {{"x", parsed("u*delay(v,1)+2")}}),
            parsed("delay(u,0.5)*delay(v,1.5)+2"));
  EXPECT_EQ(delay(parsed("x*y"), parsed("T")), parsed("delay(x,T)*delay(y,T)"));
  EXPECT_EQ(delay(parsed("t"), parsed("T")), parsed("t-T"));
}

TEST(Substitute, DelaysWithoutANumberReadBackAsTheyAreWritten) {
  for (const std::string text : {"delay(x,T)", "x*delay(y,2*T+1)", "delay(x,0.5+T)"}) {
    EXPECT_EQ(parsed(text).to_string(), text);
    EXPECT_EQ(parsed(parsed(text).to_string()), parsed(text));
  }
  EXPECT_EQ(parsed("delay(x,T)").hash(), parsed("delay(x,T)").hash());
  EXPECT_FALSE(parsed("delay(x,T)") == parsed("delay(x,S)"));
}

TEST(Substitute, NothingIsComputedBeforeADelayHasANumber) {
  const Expression late = parsed("delay(x,T)");
  try {
    const Program program({&late, 1}, {{"x", "T"}, {}});
    FAIL() << "the delay is not known";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("delay(x,T)"), std::string::npos) << error.what();
  }
}

TEST(Substitute, DerivativesHoldDelaysFixed) {
  EXPECT_EQ(differentiate(parsed("x*delay(x,T)"), "x"), parsed("delay(x,T)"));
  EXPECT_THROW(differentiate(parsed("x*delay(x,T)"), "T"), ModelError);
}

TEST(Contains, FindsAnOperationAnywhere) {
  EXPECT_TRUE(contains(parsed("1+sin(2*delay(x,1))"), Operation::Delay));
  EXPECT_FALSE(contains(parsed("1+sin(2*x)"), Operation::Delay));
}

TEST(UnboundDelays, NamesAreThoseOfTheTimes) {
  EXPECT_EQ(names_in_delay_times(parse_expression("a*sin(delay(x,T+2*S))+delay(y,1)")),
            (std::set<std::string>{"S", "T"}));
}

TEST(UnboundDelays, StatesAndTimeAreNoDelays) {
  const VariableIndex variables({.states = {"x", "y"}, .inputs = {"T"}});
  EXPECT_NO_THROW(check_delay_times(parse_expression("y*delay(x,T)"), variables));
  EXPECT_THROW(check_delay_times(parse_expression("delay(x,y)"), variables), ModelError);
  EXPECT_THROW(check_delay_times(parse_expression("1+sin(delay(x,0.5*t))"), variables),
               ModelError);
}

}  // namespace
}  // namespace lacuna
