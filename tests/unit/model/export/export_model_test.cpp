// SPDX-License-Identifier: MIT
#include "lacuna/model/export/export_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "core/base/names.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "model/equations/formula_channel.hpp"
#include "model/export/languages.hpp"
#include "support/other_programs.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// All operations, names that are words of languages, signs and powers that need parentheses.
constexpr const char* kModel = R"(time s
input u [V]
input in
state x [m]
state lambda
state e2
dx/dt = -x^2 - (-x)^3/(2*lambda) + sin(x)*cos(u) - tan(0.1*x) + asin(0.1*x)*acos(0.1*u) + atan(x)
dlambda/dt = tanh(x)*exp(-x) - log(2+abs(x)) + sqrt(abs(u)) + sign(x) - step(u) + 2*in - 7
de2/dt = min(x,u) - 3*max(x,in) + clip(e2,-0.5,0.5) + 2^x - x/(u-3) - x/(e2*(x-9)) + t + (x-u)^-2
)";

constexpr std::array<double, 6> kPoint = {0.7, 0.3, -0.4, 1.2, -0.8, 2.5};  // t, x..., u, in

std::vector<double> expected_rates(const OdeModel& model) {
  std::vector<double> rates(model.states().size());
  CompiledModel compiled = model.compile();
  compiled.evaluate(kPoint[0], &kPoint[1], &kPoint[4], nullptr, rates.data());
  return rates;
}

void expect_rates(const std::vector<double>& numbers) {
  const std::vector<double> expected = expected_rates(parse_ode(kModel, "all.ode"));
  ASSERT_EQ(numbers.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(numbers[k], expected[k], 1e-12 * (1.0 + std::abs(expected[k])));
}

std::string exported(const std::string& format) {
  return export_model(parse_ode(kModel, "all.ode"), format);
}

TEST(ExportModel, CIsCompiledAndGivesTheRates) {
  if (!testing::can_run("cc --version")) GTEST_SKIP() << "there is no C compiler";
  const testing::TemporaryFolder place;
  const std::string source = place.write("model.c", exported("c") + R"(#include <stdio.h>
int main(void) {
  const double x[] = {0.3, -0.4, 1.2}, u[] = {-0.8, 2.5};
  double rate[3];
  lacuna_rate(0.7, x, u, rate);
  printf("%.17g %.17g %.17g\n", rate[0], rate[1], rate[2]);
})");
  const std::string program = place.file("model");
  ASSERT_TRUE(testing::can_run("cc -std=c99 -Wall -Wextra -Werror " + source + " -o " +
                               program + " -lm"));
  expect_rates(testing::printed_numbers(program));
}

/// dv/dt = -v/2 + u^2 - v^3 from v = 0: the voltage of the sub-circuit after 1 s.
TEST(ExportModel, SpiceHasTheSolutionInNgspice) {
  if (!testing::can_run("ngspice --version")) GTEST_SKIP() << "there is no ngspice";
  const testing::TemporaryFolder place;
  const OdeModel model = parse_ode("input u\ndv/dt = -v/2 + u^2 - v^3\n", "v.ode");
  const std::string deck = place.write(
      "deck.cir", "* test\n" + export_model(model, "spice") +
                      "Vu u 0 1.5\nX1 u v lacuna_model\n.ic v(v)=0\n.tran 1m 1 0 1m uic\n"
                      ".meas tran last find v(v) at=1\n.end\n");
  // Of dv/dt = f(v) with classical Runge-Kutta steps.
  const auto f = [](double v) { return -v / 2.0 + 2.25 - v * v * v; };
  double v = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double h = 1e-3, a = f(v), b = f(v + 0.5 * h * a), c = f(v + 0.5 * h * b),
                 d = f(v + h * c);
    v += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  const auto numbers = testing::printed_numbers(
      "ngspice -b " + deck + " 2>/dev/null | sed -n 's/^last *= *\\([^ ]*\\).*/\\1/p'");
  ASSERT_EQ(numbers.size(), 1u);
  EXPECT_NEAR(numbers[0], v, 1e-3);
}

TEST(ExportModel, SpiceWritesWholePowersAsProducts) {
  const std::string text = export_model(
      parse_ode("input x2\ndx/dt = x^3 + x2^-2 + abs(x)^0.5 + t\n", "x.ode"), "spice");
  EXPECT_THAT(text, HasSubstr("I=(1*(v(x))*(v(x))*(v(x)))"));
  EXPECT_THAT(text, HasSubstr("(1/(1*(v(x2))*(v(x2))))"));
  EXPECT_THAT(text, HasSubstr("sqrt(abs(v(x)))"));
  EXPECT_THAT(text, HasSubstr(" + time"));
}

TEST(ExportModel, ModelicaHasUnitsAndDelays) {
  const std::string text = export_model(
      parse_ode("input u [V]\nstate x [m]\ndx/dt = -x + delay(u,0.5) + step(x)\n", "x.ode"),
      "modelica");
  EXPECT_THAT(text, HasSubstr("input Real u(unit=\"V\");"));
  EXPECT_THAT(text,
              HasSubstr("der(x) = -x + delay(u, 0.5) + (if x >= 0.0 then 1.0 else 0.0);"));
}

TEST(ExportModel, RefusesWhatALanguageDoesNotHave) {
  const OdeModel delayed = parse_ode("input u\ndx/dt = delay(u,0.5)\n", "x.ode");
  for (const std::string& format : export_formats()) {
    if (format == "modelica" || format == "latex") continue;
    EXPECT_THROW(export_model(delayed, format), ModelError) << format;
  }
  EXPECT_THROW(export_model(delayed, "fortran"), ConfigError);
}

OdeModel delayed_by_parameter() {
  return parse_ode_system("param T = 2\nstate x\ndx/dt = -delay(x,T)\n", "x.ode").symbolic();
}

TEST(ExportModel, RefusesWhatIsNoRate) {
  for (const char* format : {"modelica", "latex"})
    EXPECT_THROW(export_model(delayed_by_parameter(), format), ModelError) << format;
  const OdeModel channel({formula_channel("y", "V")}, {}, {{}});
  for (const std::string& format : export_formats())
    EXPECT_THROW(export_model(channel, format), ModelError) << format;
}

/// A unit that would be code in every language.
OdeModel with_unit(const std::string& unit) {
  return OdeModel({{"x", unit}}, {}, {{}}, unit)
      .with_outputs({{"y", unit, Expression::variable("x")}});
}

/// Number of lines that are no comments.
std::ptrdiff_t code_lines(const std::string& text) {
  std::istringstream lines(text);
  std::ptrdiff_t count = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.empty() || std::string("/%#*").find(line[0]) == std::string::npos) ++count;
  return count;
}

TEST(ExportModel, UnitsAreNoCode) {
  for (const char* unit : {"s\rint evil = 42; //", "\nevil", "\xe2\x80\xae", "\xff"})
    EXPECT_THROW(with_unit(unit), ModelError) << unit;
  for (const char* unit :
       {"coding:unicode_escape\\nevil", "\"); evil(\"", "\\", "*/ evil /*", "\xc2\xb0"})
    for (const std::string& format : export_formats()) {
      const std::string text = export_model(with_unit(unit), format);
      const std::string plain = export_model(with_unit("V"), format);
      EXPECT_EQ(code_lines(text), code_lines(plain)) << text;
      for (const char c : text) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << format;
      EXPECT_EQ(text.find("evil = 42; //"), std::string::npos) << format;
    }
  EXPECT_THAT(export_model(with_unit("\""), "modelica"), HasSubstr("(unit=\"<U+0022>\")"));
  EXPECT_THAT(export_model(with_unit("V"), "c"), HasSubstr("// Outputs: y [V]."));
}

TEST(ExportModel, PythonHasItsEncodingInTheFirstLine) {
  EXPECT_EQ(
      export_model(with_unit("coding: utf-7"), "python").rfind("# -*- coding: ascii -*-\n", 0),
      0u);
}

/// Names of the language and of the export itself, names that are one, names of other names.
TEST(ExportModel, NamesAreOthersWhereTheyMeanSomething) {
  const OdeModel model = parse_ode(
      "input input\ndlambda/dt = X - lambda_\ndlambda_/dt = input\ndx/dt = gnd\n"
      "dX/dt = state\ndgnd/dt = void\ndstate/dt = x\ndvoid/dt = _x\nd_x/dt = 1\n",
      "x.ode");
  EXPECT_THAT(
      export_model(model, "python"),
      HasSubstr("# Names that are others here: lambda is lambda_2, state is state_, _x is "
                "v_x, input is\n#   input_.\n"));
  EXPECT_THAT(export_model(model, "c"), HasSubstr("= void_;"));
  EXPECT_THAT(export_model(model, "matlab"), HasSubstr("  input_ = input(1);"));
  EXPECT_THAT(export_model(model, "modelica"), HasSubstr("der(x) = gnd;"));
  const std::string spice = export_model(model, "spice");
  EXPECT_THAT(spice, HasSubstr("Blambda 0 lambda I=v(X_) - v(lambda_)"));
  EXPECT_THAT(spice, HasSubstr("Bx 0 x I=v(gnd_)"));
}

/// ngspice rounds what has more than 11 digits.
TEST(ExportModel, SpiceHasAllDigits) {
  EXPECT_THAT(export_model(parse_ode("dx/dt = -1.2345678901234567*x + 0.5", "x.ode"), "spice"),
              HasSubstr("I=(-1.23456789 - 1.234568003e-10)*v(x) + 0.5"));
}

TEST(ExportModel, SpiceKeepsTheSignsOfPowers) {
  const std::string text =
      export_model(parse_ode("dx/dt = x^11 + x^12 + x^1.5\n", "x.ode"), "spice");
  EXPECT_THAT(text, HasSubstr("(pwr(v(x), 11)) + (pow(v(x), 12)) + "
                              "((v(x)) >= 0 ? pow(v(x), 1.5) : sqrt(v(x)))"));
}

/// Powers of powers would double the text with every one.
TEST(ExportModel, SpiceIsNoLongerThanItsFormula) {
  std::string formula = "x";
  for (int i = 0; i < 30; ++i) formula = "(" + formula + "+1)^3";
  EXPECT_LT(export_model(parse_ode("dx/dt = sin(" + formula + ")\n", "x.ode"), "spice").size(),
            20000u);
}

TEST(ExportModel, MatlabIsNotComplex) {
  const std::string text = export_model(
      parse_ode("dx/dt = sqrt(x) + log(x) + asin(x) + acos(x) + x^0.5 + x^2\n", "x.ode"),
      "matlab");
  EXPECT_THAT(text,
              HasSubstr("(lacuna_real(sqrt(x)) + lacuna_real(log(x)) + lacuna_real(asin(x)) "
                        "+ lacuna_real(acos(x)) + lacuna_real(sqrt(x)) + x^2)"));
  EXPECT_THAT(text, HasSubstr("\nfunction v = lacuna_real(v)\n"));
  EXPECT_THAT(text, Not(HasSubstr("lacuna_min")));
}

/// Object-like macros of the headers, as the compiler on this machine lists them.
TEST(ExportModel, MacrosAreNoNamesInC) {
  if (!testing::can_run("cc --version")) GTEST_SKIP() << "there is no C compiler";
  const testing::TemporaryFolder place;
  place.write("c.c", "#include <math.h>\n");
  place.write("c.cpp", "#include <array>\n#include <cmath>\n");
  std::string macros;
  for (const char* call : {"cc -std=c99 c.c", "cc -std=gnu17 c.c", "c++ -std=gnu++20 c.cpp"}) {
    ASSERT_TRUE(testing::can_run("cd " + place.file("") + " && " + call + " -dM -E -o macros"));
    macros += place.read("macros");
  }
  std::istringstream lines(macros);
  int known = 0;
  for (std::string define, macro; lines >> define >> macro; std::getline(lines, define)) {
    if (!is_identifier(macro) || macro.front() == '_') continue;
    EXPECT_NE(foreign_names(std::vector<std::string>{macro}, c_names()).at(macro), macro);
    ++known;
  }
  EXPECT_GT(known, 50);
}

}  // namespace
}  // namespace lacuna
