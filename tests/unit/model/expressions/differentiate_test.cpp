// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lacuna/model/expressions/program.hpp"
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

}  // namespace
}  // namespace lacuna
