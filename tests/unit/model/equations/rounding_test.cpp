// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/rounding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

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
  EXPECT_EQ(coefficient_of(rounded(model_of({x, 1.23456789, 0.1}), {.full = true})), 1.23456789);
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
