// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna {
namespace {

const Variables kOnlyX{{"x"}, {}};

OdeModel decay(const WeightedTerm& summand) {
  return OdeModel({{"x", "V"}}, {}, {{summand}}, "ms");
}

TEST(FormatModel, LayoutIsOneTermPerLine) {
  EXPECT_EQ(
      format_model(decay({Term::parse("x", kOnlyX), -0.5, 0.01, {{-0.52, -0.48}}})),
      "{\"format\": \"lacuna.model/1\",\n"
      " \"time_unit\": \"ms\",\n"
      " \"states\": [\n"
      "  {\"name\":\"x\",\"unit\":\"V\"}],\n"
      " \"inputs\": [],\n"
      " \"equations\": [\n"
      "  {\"state\": \"x\", \"terms\": [\n"
      "    {\"term\":\"x\",\"coefficient\":-0.5,\"stderr\":0.01,\"ci95\":[-0.52,-0.48]}]}]}\n");
}

TEST(FormatModel, CoefficientsSurviveToTheLastBit) {
  Random random(42);
  for (int i = 0; i < 2000; ++i) {
    const auto pattern = random.below(1ULL << 53) << 11 | random.below(1ULL << 11);
    const double coefficient = std::bit_cast<double>(pattern);
    if (!std::isfinite(coefficient)) continue;
    const OdeModel model = decay({Term::parse("sin(0.1*x)", kOnlyX), coefficient});
    const OdeModel again = parse_model(format_model(model), "m");
    ASSERT_EQ(std::bit_cast<std::uint64_t>(again.equations()[0][0].coefficient), pattern);
    ASSERT_EQ(again.equations()[0][0].term, model.equations()[0][0].term);
  }
}

TEST(FormatModel, ErrorsThatAreNotFiniteAreLeftOut) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::string text = format_model(
      decay({Term::parse("x", kOnlyX), 1.0, std::nan(""), {{-kInfinity, kInfinity}}}));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("stderr")));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("ci95")));
  EXPECT_EQ(parse_model(text, "m").coefficient(0, "x"), 1.0);
}

TEST(FormatModel, IntervalsThatSayNothingAreLeftOut) {
  const std::string text =
      format_model(decay({Term::parse("x", kOnlyX), 7.5e-12, 1e71, {{-2e71, 2e71}}}));
  EXPECT_THAT(text, ::testing::HasSubstr("\"stderr\":1e+71"));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("ci95")));
}

constexpr const char* kAll = R"(time min
input u [V] hold zero
state x [V]
state z
param k = 0.05 [1/s] in 0..1
param m = 2 in 1.. per_record
param w = 3 in ..4 fixed
param j = -1e-09 fixed
dx/dt = -2*sqrt(x)*k + 4*u + sin(w*x) - z
dz/dt = x*z - 1*z + 3*(x-z)^1 - 2*u*(x+1)^1 - 0.25*(x-m) + 1*(z-w)/(1+x) + (m*x-0.5*z)^1
fixed dx/dt: u
y = abs(x)+m [V]
s = x
initial x = 0 fixed
initial z = 1.5 deviation 0.25
)";

TEST(FormatOde, GivesBackWhatWasWritten) {
  EXPECT_EQ(format_ode(parse_ode_system(kAll, "m.ode")), kAll);
}

TEST(FormatOde, JsonAndBackIsTheSameModel) {
  const SystemModel system = parse_ode_system(kAll, "m.ode");
  const std::string json = format_model(system);
  const SystemModel again = parse_system(json, "m.json");
  EXPECT_EQ(format_model(again), json);
  EXPECT_EQ(format_ode(again), kAll);
  EXPECT_EQ(format_model(parse_ode_system(format_ode(again), "m.ode")), json);
}

/// Names and brackets of circuits and motors stay; a sum without a parameter is multiplied out.
TEST(FormatOde, FormulasOfParametersStayAsTheyAreWritten) {
  const char* written =
      "time s\ninput u [V]\nstate i [A]\nstate w\nparam R = 2 [Ohm]\nparam L = 0.01 [H]\n"
      "param K = 0.05\nparam J = 1e-04 fixed\n"
      "di/dt = (u-R*i-K*w)/L\ndw/dt = i*K*J^-1 - 0.5*w + 0.5*i\n";
  const SystemModel system = parse_ode_system(written, "m.ode");
  EXPECT_EQ(format_ode(system), written);
  EXPECT_EQ(format_ode(parse_ode_system(
                "param R = 2\nparam L = 3\ndi/dt = -(R*i)/L - 0.5*(i - 4)\n", "m.ode")),
            "time s\nstate i\nparam R = 2\nparam L = 3\ndi/dt = -i*R*L^-1 - 0.5*i + 2\n");
  // With numbers for the names the terms are those of the products.
  const OdeModel numbers = system.model();
  EXPECT_DOUBLE_EQ(numbers.coefficient(0, "i"), -200.0);
  EXPECT_DOUBLE_EQ(numbers.coefficient(0, "u"), 100.0);
  EXPECT_DOUBLE_EQ(numbers.coefficient(0, "w"), -5.0);
}

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
