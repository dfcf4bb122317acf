// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {
namespace {

std::string text_of(const std::vector<std::pair<double, std::string>>& terms,
                    std::optional<int> digits = {}) {
  const Variables variables{{"x", "y"}, {}};
  Equation equation;
  for (const auto& [coefficient, text] : terms)
    equation.push_back({Term::parse(text, variables), coefficient});
  const std::string text =
      to_text(OdeModel({{"x", ""}, {"y", ""}}, {}, {equation, {}}), digits);
  const std::string expected_end = "\ndy/dt = 0";
  EXPECT_EQ(text.substr(text.find('\n')), expected_end);
  return text.substr(0, text.find('\n'));
}

TEST(ModelText, LeavesOutFactorsOfOne) {
  EXPECT_EQ(text_of({{-1.0, "x"}, {-1.0, "y"}}), "dx/dt = -x - y");
  EXPECT_EQ(text_of({{1.0, "x"}, {0.2, "y"}}), "dx/dt = x + 0.2*y");
  EXPECT_EQ(text_of({{0.2, "1"}, {-5.7, "y"}, {1.0, "x*y"}}), "dx/dt = 0.2 - 5.7*y + x*y");
  EXPECT_EQ(text_of({{1.0, "1"}, {-1.0, "x"}}), "dx/dt = 1 - x");
  EXPECT_EQ(text_of({{-1.0, "1"}}), "dx/dt = -1");
}

TEST(ModelText, AnEmptyEquationIsZero) {
  EXPECT_EQ(text_of({}), "dx/dt = 0");
  EXPECT_EQ(text_of({{0.0, "x"}}), "dx/dt = 0");
}

TEST(ModelText, TermsThatAreSumsOrSignedStandInParentheses) {
  EXPECT_EQ(text_of({{2.0, "x+y"}, {-1.0, "x-y"}}), "dx/dt = 2*(x+y) - (x-y)");
  EXPECT_EQ(text_of({{1.0, "-x*y"}, {3.0, "-x"}}), "dx/dt = (-x*y) + 3*(-x)");
}

TEST(ModelText, ReciprocalsTakeTheCoefficientAsNumerator) {
  EXPECT_EQ(text_of({{-3.0, "1/(1+x^2)"}, {1.0, "1/(1+y)"}}), "dx/dt = -3/(1+x^2) + 1/(1+y)");
  EXPECT_EQ(text_of({{2.0, "1/x"}}), "dx/dt = 2*x^-1");
}

TEST(ModelText, NumbersAreUnroundedUnlessDigitsAreGiven) {
  EXPECT_EQ(text_of({{0.1 + 0.2, "x"}}), "dx/dt = 0.30000000000000004*x");
  EXPECT_EQ(text_of({{0.1 + 0.2, "x"}}, 3), "dx/dt = 0.3*x");
}

}  // namespace
}  // namespace lacuna
