// SPDX-License-Identifier: MIT
#include "model/equations/linear_terms.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

const Variables kDrivenSpace{.states = {"x", "y", "z"}, .inputs = {"u"}};

std::map<std::string, double> terms_of(const std::string& formula) {
  std::map<std::string, double> terms;
  for (const WeightedTerm& one :
       linear_terms(parse_summands(formula), VariableIndex(kDrivenSpace)))
    terms[one.term.name()] = one.coefficient;
  return terms;
}

using Terms = std::map<std::string, double>;

TEST(LinearTerms, PowersDivisorsAndArgumentsStayAsTheyAre) {
  EXPECT_EQ(terms_of("(x-y)^2"), (Terms{{"(x-y)^2", 1.0}}));
  EXPECT_EQ(terms_of("3*(x+1)/(2+x)"), (Terms{{"x/(2+x)", 3.0}, {"1/(2+x)", 3.0}}));
  EXPECT_EQ(terms_of("2*sin(3*x+1)"), (Terms{{"sin(3*x+1)", 2.0}}));
}

TEST(LinearTerms, SumsToThePowerOfOneStayTogether) {
  EXPECT_EQ(terms_of("520*(x-y)^1 - x"), (Terms{{"x-y", 520.0}, {"x", -1.0}}));
  EXPECT_EQ(terms_of("u*(2*x-y)^1"), (Terms{{"u*(2*x-y)", 1.0}}));
  for (const char* term : {"x-y", "u*(2*x-y)", "(x+y)*(x-1)/(z+2)", "x^2*y", "sin(x-y)"}) {
    const Expression written = kept_together(parse_expression(term));
    EXPECT_EQ(terms_of(written.to_string()),
              (Terms{{Term::parse(term, kDrivenSpace).name(), 1.0}}))
        << written.to_string();
  }
}

/// The sum has the value of the formula, wherever it is evaluated.
TEST(LinearTerms, HaveTheValueOfTheFormula) {
  const Expression formula =
      parse_expression("-(x-2*y)*(z/3+u*(1-x))/(1+y^2) + 4*exp(-x)*(y-1) - -z");
  std::vector<Expression> parts{formula};
  const Equation terms = linear_terms(std::vector{formula}, VariableIndex(kDrivenSpace));
  for (const WeightedTerm& one : terms) parts.push_back(one.term.expression());
  const Program program(parts, kDrivenSpace);
  Program::Workspace workspace;
  Random random(7);
  for (int trial = 0; trial < 20; ++trial) {
    Vector slots(program.slots()), out(program.outputs());
    for (double& slot : slots) slot = random.normal();
    program.evaluate(slots.data(), out.data(), workspace);
    double sum = 0.0;
    for (std::size_t i = 0; i < terms.size(); ++i)
      sum += terms[i].coefficient * out[static_cast<Index>(i) + 1];
    EXPECT_NEAR(sum, out[0], 1e-12 * (1.0 + std::abs(out[0])));
  }
}

TEST(LinearTerms, RefusesWhatIsNoNumberAndWhatHasNoEnd) {
  EXPECT_THROW(terms_of("x/0"), ModelError);
  EXPECT_THROW(terms_of("x*q"), ModelError);
  std::string product = "(x+y+z+u)";
  for (int i = 0; i < 5; ++i) product += "*(x+y+z+u)";
  EXPECT_THROW(terms_of(product), ModelError);
}

}  // namespace
}  // namespace lacuna
