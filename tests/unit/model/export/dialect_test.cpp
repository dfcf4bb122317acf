// SPDX-License-Identifier: MIT
#include "model/export/dialect.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

Dialect test_dialect() {
  return {.name = "test", .names = {{"x", "x"}, {"y", "y"}, {"z", "z"}, {"lambda", "lambda_"}}};
}

std::string plain(const std::string& formula) {
  return code(parse_expression(formula), test_dialect());
}

std::string sum(const std::string& formula) {
  const OdeModel model = parse_ode("input y\ninput z\ndx/dt = " + formula + "\n", "x.ode");
  return code(model.equations()[0], test_dialect());
}

/// x + (y - z) and (x + y) - z are not the same number where x and y nearly cancel.
TEST(Dialect, KeepsTheOrderOfWhatIsComputed) {
  EXPECT_EQ(plain("x+(y-z)"), "x + (y - z)");
  EXPECT_EQ(plain("x*(y*z)"), "x*(y*z)");
  EXPECT_EQ(sum("2*x - 3*y*z + (y-z)^1 - z"), "2*x - 3*y*z + (y - z) - z");
  EXPECT_EQ(sum("-x + 0.5"), "-x + 0.5");
  EXPECT_EQ(sum("1e200*x*y - 1e-200*x*z"), "1e+200*(x*y) - 1e-200*(x*z)");
  EXPECT_EQ(sum("0"), "0");
}

/// Deeper than any formula may be.
TEST(Dialect, SumsAreAsLongAsTheyAre) {
  const Variables variables{{"x"}, {}};
  Equation equation;
  std::string expected;
  for (int i = 2; i < 3000; ++i) {
    equation.push_back({Term::parse("x^" + std::to_string(i), variables), 1.0});
    expected += (i > 2 ? " + x^" : "x^") + std::to_string(i);
  }
  EXPECT_EQ(code(equation, test_dialect()), expected);
}

TEST(Dialect, RefusesWhatIsNestedTooDeepForCompilers) {
  const auto nested = [](int depth) {
    Expression formula = Expression::variable("x");
    for (int i = 0; i < depth; ++i) formula = Expression::make(Operation::Sin, {formula});
    return formula;
  };
  EXPECT_NO_THROW(code(nested(150), test_dialect()));
  EXPECT_THROW(code(nested(151), test_dialect()), ModelError);
}

}  // namespace
}  // namespace lacuna
