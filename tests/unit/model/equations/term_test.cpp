// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/term.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/rounding.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "model/equations/linear_terms.hpp"

namespace lacuna {
namespace {

using Exponents = std::vector<int>;
using Terms = std::map<std::string, double>;

const Variables kPlane{{"x", "y"}, {"u"}};

Term term(const std::string& text) { return Term::parse(text, kPlane); }

TEST(Term, MonomialsAreRecognisedHoweverTheyAreWritten) {
  const std::vector<std::pair<std::string, Exponents>> cases{
      {"y*x*x", {2, 1, 0, 0}},     {"x^2*y", {2, 1, 0, 0}},       {"(x*y)^2", {2, 2, 0, 0}},
      {"x/y", {1, -1, 0, 0}},      {"1/y^2", {0, -2, 0, 0}},      {"1", {0, 0, 0, 0}},
      {"t*u*x", {1, 0, 1, 1}},     {"x*(y*(u*x))", {2, 1, 1, 0}}, {"1*x", {1, 0, 0, 0}},
      {"(x^-1)^-2", {2, 0, 0, 0}}, {"x^2/x", {1, 0, 0, 0}},       {"x^0", {0, 0, 0, 0}}};
  for (const auto& [text, exponents] : cases) {
    ASSERT_TRUE(term(text).exponents()) << text;
    EXPECT_EQ(*term(text).exponents(), exponents) << text;
    EXPECT_EQ(term(text), Term::monomial(exponents, kPlane)) << text;
  }
}

TEST(Term, NamesAreInTheOrderOfTheVariables) {
  EXPECT_EQ(term("u*y*x").name(), "x*y*u");
  EXPECT_EQ(term("y*x*x").name(), "x^2*y");
  EXPECT_EQ(term("1/x").name(), "x^-1");
  EXPECT_EQ(term("t*y/x^2").name(), "x^-2*y*t");
  EXPECT_EQ(term("x/x").name(), "1");
  EXPECT_EQ(term("y*x*x").expression().to_string(), "x^2*y");
}

TEST(Term, OtherTermsKeepWhatWasWritten) {
  for (const std::string text : {"2*x", "sin(x)", "x*(y-1)", "y*abs(y)", "-x", "x^0.5", "x^y",
                                 "x^-1.5", "delay(x,0.1)*y", "x^2000", "x/2", "sign(u)"}) {
    EXPECT_FALSE(term(text).exponents()) << text;
    EXPECT_EQ(term(text).name(), text);
  }
}

TEST(Term, UnknownNamesAreErrors) {
  try {
    term("x*q");
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_EQ(error.where(), "term 'x*q', column 3");
    EXPECT_EQ(error.remedy(), "known are: x, y, u, t");
  }
  EXPECT_THROW(Term(Expression::variable("q"), kPlane), ModelError);
}

TEST(Term, KnowsTheVariableThatItIs) {
  const Variables plane{.states = {"x", "y"}, .inputs = {"u"}};
  EXPECT_EQ(Term::parse("y", plane).variable(), 1);
  EXPECT_EQ(Term::parse("u*x/x", plane).variable(), 2);
  EXPECT_EQ(Term::parse("t", plane).variable(), 3);
  for (const char* other : {"1", "y^2", "x*y", "1/x", "sin(x)"})
    EXPECT_FALSE(Term::parse(other, plane).variable()) << other;
}

TEST(Term, TakesNoMoreRoomWithMoreVariables) {
  Variables many;
  for (int i = 0; i < 20000; ++i) many.states.push_back("x" + std::to_string(i));
  const VariableIndex index(many);
  std::vector<Term> terms;
  for (const std::string& name : many.states)
    terms.emplace_back(parse_expression(name + "*x0"), index);
  EXPECT_EQ(terms[7].name(), "x0*x7");
  EXPECT_EQ((*terms[7].exponents())[7], 1);
  EXPECT_EQ(terms[7].exponents()->size(), 20001u);
}

const Variables kDrivenSpace{.states = {"x", "y", "z"}, .inputs = {"u"}};

std::map<std::string, double> terms_of(const std::string& formula) {
  std::map<std::string, double> terms;
  for (const WeightedTerm& one :
       linear_terms(parse_summands(formula), VariableIndex(kDrivenSpace)))
    terms[one.term.name()] = one.coefficient;
  return terms;
}

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

const Variables kOnlyX{{"x"}, {}};

SystemModel model_of(WeightedTerm summand) {
  return OdeModel({{"x", ""}}, {}, {{std::move(summand)}});
}

double coefficient_of(const SystemModel& model) {
  return model.symbolic().equations()[0][0].coefficient;
}

TEST(Rounding, TwoDigitsOfTheError) {
  // The last digit of 1.2345(67) is that of the second digit of the error.
  EXPECT_EQ(digits_of(1.2345678, 0.0067), 5);
  EXPECT_EQ(digits_of(123.45678, 0.0067), 7);
  EXPECT_EQ(digits_of(0.001, 5.0), 2);
  EXPECT_EQ(digits_of(1.0, 1e-30), 17);
  EXPECT_EQ(digits_of(1.0, 0.0), 4);
}

TEST(Rounding, MovesACoefficientByLessThanATwentiethOfItsInterval) {
  for (const double half : {0.9, 0.5, 0.11, 0.099, 0.01}) {
    const double value = 1.23456789;
    const Term x = Term::parse("x", kOnlyX);
    const double rounded_value = coefficient_of(
        rounded(model_of({x, value, {}, std::array{value - half, value + half}})));
    EXPECT_NE(rounded_value, value) << half;
    EXPECT_LE(std::abs(rounded_value - value), half / 20.0) << half;
  }
}

/// 1.9599639845 standard errors (the normal distribution's table) are half an interval of 95 %:
/// 0.0053 has another second digit than 0.0104.
TEST(Rounding, AStandardErrorIsNoHalfInterval) {
  const Term x = Term::parse("x", kOnlyX);
  const WeightedTerm summand{x, 1.23456789, 0.0053};
  EXPECT_NEAR(*half_interval(summand), 0.0053 * 1.9599639845, 1e-12);
  EXPECT_EQ(coefficient_of(rounded(model_of(summand))), 1.235);
  SystemModel model = parse_ode_system("param k = 1.23456789\ndx/dt = -k*x\n", "m");
  std::vector<Parameter> parameters = model.parameters();
  parameters[0].standard_error = 0.0053;
  EXPECT_EQ(rounded({model.symbolic(), parameters}).parameters()[0].value, 1.235);
}

TEST(Rounding, LeavesWhatIsFixedOrHasNoInterval) {
  const Term x = Term::parse("x", kOnlyX);
  EXPECT_EQ(coefficient_of(rounded(model_of({x, 1.23456789}))), 1.23456789);
  EXPECT_EQ(coefficient_of(rounded(model_of({x, 1.23456789, 0.1, {}, true}))), 1.23456789);
  EXPECT_EQ(coefficient_of(rounded(model_of({x, 1.23456789}), {.significant = 3})), 1.23);
  EXPECT_EQ(coefficient_of(rounded(model_of({x, 1.23456789, 0.1}), {.full = true})),
            1.23456789);
}

TEST(Rounding, ShortensNumbersInsideTermsUnlessTermsBecomeOne) {
  const Term tanh = Term::parse("tanh(x/0.0123456789012345)", kOnlyX);
  EXPECT_EQ(rounded(model_of({tanh, 1.0})).symbolic().equations()[0][0].term.name(),
            "tanh(x/0.012345679)");
  const Term a = Term::parse("sin(1.0000000001*x)", kOnlyX);
  const Term b = Term::parse("sin(1.0000000002*x)", kOnlyX);
  const SystemModel two = rounded(OdeModel({{"x", ""}}, {}, {{{a, 1.0}, {b, 2.0}}}));
  ASSERT_EQ(two.symbolic().equations()[0].size(), 2u);
  EXPECT_NE(two.symbolic().equations()[0][0].term, two.symbolic().equations()[0][1].term);
}

TEST(Rounding, ParametersStayInTheirRanges) {
  SystemModel model = parse_ode_system("param k = 0.123456 in 0.1234..1\ndx/dt = -k*x\n", "m");
  std::vector<Parameter> parameters = model.parameters();
  parameters[0].ci95 = std::array{0.1234, 0.1236};
  EXPECT_EQ(rounded({model.symbolic(), parameters}).parameters()[0].value, 0.12346);
  parameters[0].ci95 = std::array{0.11, 0.13};
  EXPECT_EQ(rounded({model.symbolic(), parameters}).parameters()[0].value, 0.123456)
      << "0.123 is below the least value";
}

TEST(Rounding, DigitsAreReadAndOthersRefused) {
  EXPECT_TRUE(parse_digits("full").full);
  EXPECT_FALSE(parse_digits("auto").full || parse_digits("auto").significant);
  EXPECT_EQ(parse_digits("5").significant, 5);
  for (const char* text : {"0", "18", "2.5", "many", ""})
    EXPECT_THROW(parse_digits(text), ConfigError) << text;
}

TEST(Rounding, NumbersInFormulasForPeople) {
  const Expression form = parse_expression("(1+0.8849609375000003*exp(-(x/8.2063)^2))*sign(x)");
  EXPECT_EQ(with_rounded_numbers(form, 4).to_string(),
            parse_expression("(1+0.885*exp(-(x/8.206)^2))*sign(x)").to_string());
}

TEST(Rounding, SumsWithNumbersAreWrittenPlainly) {
  const auto plain = [](const Expression& e) { return with_rounded_numbers(e, 3).to_string(); };
  const Expression y = Expression::variable("y");
  const auto number = [](double value) { return Expression::number(value); };
  const auto minus = [](const Expression& a, const Expression& b) {
    return Expression::make(Operation::Subtract, {a, b});
  };
  EXPECT_EQ(plain(minus(number(-0.0), y)), "-y");
  EXPECT_EQ(plain(minus(Expression::make(Operation::Negate, {number(0.0)}), y)), "-y");
  EXPECT_EQ(plain(minus(y, number(-2.00049))), "y+2");
  EXPECT_EQ(plain(Expression::make(Operation::Add, {y, number(-2.00049)})), "y-2");
  EXPECT_EQ(plain(minus(y, number(0.0))), "y");
  EXPECT_EQ(plain(minus(number(-2.5), y)), "-2.5-y");
}

TEST(Rounding, TimesOfDelaysAreNumbersInside) {
  const Expression form = parse_expression("delay(v,0.006999657863728598)-v");
  EXPECT_EQ(with_rounded_numbers(form, 4).to_string(),
            parse_expression("delay(v,0.007)-v").to_string());
}

}  // namespace
}  // namespace lacuna
