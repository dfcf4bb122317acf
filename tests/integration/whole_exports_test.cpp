// SPDX-License-Identifier: MIT
// Exports of models with parameters, outputs and a start, run by the programs they are for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/text.hpp"
#include "lacuna/model/export/export_model.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/other_programs.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna::testing {
namespace {

using ::testing::HasSubstr;

constexpr const char* kTanks =
    "input u [V]\nparam k1 = 0.5 [1/s] in 0..1\nparam k4 = 0.25 fixed\n"
    "dx1/dt = -k1*sqrt(x1) + k4*u\ndx2/dt = k1*sqrt(x1) - 0.3*sqrt(x2)\n"
    "y = 3*x2 + k1*x1^2 [V]\ninitial x1 = 1.5\ninitial x2 = 0.5 fixed\n";

SystemModel tanks() { return parse_ode_system(kTanks, "tanks.ode"); }

/// Rates at x1, x2 and u, by the formulas above.
std::vector<double> rates(double x1, double x2, double u, double k1) {
  return {-k1 * std::sqrt(x1) + 0.25 * u, k1 * std::sqrt(x1) - 0.3 * std::sqrt(x2)};
}

void expect_numbers(const std::vector<double>& numbers, const std::vector<double>& expected) {
  ASSERT_EQ(numbers.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(numbers[i], expected[i], 1e-12 * (1.0 + std::abs(expected[i]))) << i;
}

/// One step of the method of order 4 as textbooks have it.
std::vector<double> one_step(std::vector<double> x, double u, double h) {
  const auto moved = [&](const std::vector<double>& rate, double fraction) {
    return std::vector{x[0] + fraction * h * rate[0], x[1] + fraction * h * rate[1]};
  };
  const auto rate = [&](const std::vector<double>& at) { return rates(at[0], at[1], u, 0.5); };
  const auto a = rate(x), b = rate(moved(a, 0.5)), c = rate(moved(b, 0.5));
  const auto d = rate(moved(c, 1.0));
  for (std::size_t k = 0; k < 2; ++k) x[k] += h / 6.0 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
  return x;
}

TEST(WholeExports, CHasParametersOutputsStartJacobianAndAStep) {
  if (!can_run("cc --version")) GTEST_SKIP() << "there is no C compiler";
  const TemporaryFolder place;
  const std::string source = place.write("model.c", export_model(tanks(), "c") + R"(
#include <stdio.h>
static void print(const double* v, int n) {
  for (int k = 0; k < n; ++k) printf("%.17g ", v[k]);
}
int main(void) {
  double x[2], v[4];
  const double u[] = {2.0};
  lacuna_initial(x), print(x, 2);
  lacuna_output(0.0, x, u, v), print(v, 1);
  lacuna_jacobian(0.0, x, u, v), print(v, 4);
  lacuna_advance(0.0, 0.5, x, u), print(x, 2);
  lacuna_parameters[0] = 0.75;
  lacuna_rate(0.0, x, u, v), print(v, 2);
  return 0;
})");
  ASSERT_TRUE(can_run("cc -std=c99 -Wall -Wextra -Werror " + source + " -o " +
                      place.file("model") + " -lm"));
  const std::vector<double> next = one_step({1.5, 0.5}, 2.0, 0.5);
  const std::vector<double> rate = rates(next[0], next[1], 2.0, 0.75);
  // d/dx of k sqrt(x) is k / (2 sqrt(x)).
  const double first = 0.25 / std::sqrt(1.5), second = 0.15 / std::sqrt(0.5);
  expect_numbers(printed_numbers(place.file("model")),
                 {1.5, 0.5, 3 * 0.5 + 0.5 * 2.25, -first, 0.0, first, -second, next[0], next[1],
                  rate[0], rate[1]});
}

TEST(WholeExports, CppHasParametersOutputsAndStart) {
  if (!can_run("c++ --version")) GTEST_SKIP() << "there is no C++ compiler";
  const TemporaryFolder place;
  const std::string source = place.write("model.cpp", export_model(tanks(), "cpp") + R"(
#include <cstdio>
int main() {
  lacuna_parameters[0] = 0.75;
  const auto x = lacuna_initial();
  for (const double v : lacuna_rate(0.0, x, {2.0})) std::printf("%.17g ", v);
  for (const double v : lacuna_output(0.0, x, {2.0})) std::printf("%.17g ", v);
})");
  ASSERT_TRUE(can_run("c++ -std=c++17 -Wall -Wextra -Werror " + source + " -o " +
                      place.file("model")));
  const std::vector<double> rate = rates(1.5, 0.5, 2.0, 0.75);
  expect_numbers(printed_numbers(place.file("model")),
                 {rate[0], rate[1], 3 * 0.5 + 0.75 * 2.25});
}

TEST(WholeExports, PythonHasParametersOutputsAndStart) {
  const std::string python = python_with("numpy");
  if (python.empty()) GTEST_SKIP() << "there is no numpy";
  const TemporaryFolder place;
  const std::string script = place.write(
      "model.py", export_model(tanks(), "python") +
                      "print(*('%.17g' % v for v in [*rate(0, INITIAL, [2.0]), *output(0, INITIAL, "
                      "[2.0]), *rate(0, INITIAL, [2.0], [0.75, 0.25]), *PARAMETERS]))\n");
  const std::vector<double> rate = rates(1.5, 0.5, 2.0, 0.5), other = rates(1.5, 0.5, 2.0, 0.75);
  expect_numbers(printed_numbers(python + " " + script),
                 {rate[0], rate[1], 3 * 0.5 + 0.5 * 2.25, other[0], other[1], 0.5, 0.25});
}

TEST(WholeExports, MatlabHasParametersOutputsAndStart) {
  if (!can_run("octave-cli --version")) GTEST_SKIP() << "there is no Octave";
  const TemporaryFolder place;
  const std::string text = export_model(tanks(), "matlab");
  EXPECT_THAT(text, HasSubstr("MATLAB Function block"));
  place.write("lacuna_rate.m", text);
  place.write("run_all.m",
              "[~, ~, x] = lacuna_rate(0, [1; 1], 0);\n[r, y] = lacuna_rate(0, x, 2);\n"
              "printf('%.17g ', x, r, y, lacuna_rate(0, x, 2, [0.75; 0.25]));\n");
  const std::vector<double> rate = rates(1.5, 0.5, 2.0, 0.5), other = rates(1.5, 0.5, 2.0, 0.75);
  expect_numbers(printed_numbers("cd " + place.file("") + " && octave-cli --quiet run_all.m"),
                 {1.5, 0.5, rate[0], rate[1], 3 * 0.5 + 0.5 * 2.25, other[0], other[1]});
}

TEST(WholeExports, ModelicaDeclaresAll) {
  const std::string text = export_model(tanks(), "modelica");
  for (const char* line :
       {"  parameter Real k1(unit=\"1/s\") = 0.5;\n", "  parameter Real k4 = 0.25;\n",
        "  input Real u(unit=\"V\");\n", "  Real x1(start=1.5, fixed=true);\n",
        "  output Real y(unit=\"V\");\n", "  der(x1) = -(k1*sqrt(x1)) + u*k4;\n",
        "  y = 3.0*x2 + k1*x1^2.0;\n"})
    EXPECT_THAT(text, HasSubstr(line));
}

TEST(WholeExports, SpiceHasOutputsAndStart) {
  if (!can_run("ngspice --version")) GTEST_SKIP() << "there is no ngspice";
  const TemporaryFolder place;
  const std::string text = export_model(tanks(), "spice");
  EXPECT_THAT(text, HasSubstr("* Numbers for: k1 = 0.5, k4 = 0.25.\n"));
  const std::string deck = place.write(
      "deck.cir", "* tanks\n" + text +
                      "Vu u 0 2\nX1 u x1 x2 y lacuna_model\n.tran 1m 10m uic\n"
                      ".meas tran start find v(x1) at=1m\n.meas tran out find v(y) at=1m\n.end\n");
  const std::vector<double> found =
      printed_numbers("ngspice -b " + deck +
                      " 2>/dev/null | sed -n 's/^\\(start\\|out\\) *= *\\([^ ]*\\).*/\\2/p'");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0], 1.5, 1e-3);
  EXPECT_NEAR(found[1], 3 * 0.5 + 0.5 * 2.25, 5e-3);
}

TEST(WholeExports, LatexHasThemAll) {
  const std::string text = export_model(tanks(), "latex");
  for (const char* part : {"k_{1}", "x_{1}(0) &= 1.5", "y &= ", "k_{4} &= 0.25"})
    EXPECT_THAT(text, HasSubstr(part));
}

/// A delay whose time is a parameter gets its number.
TEST(WholeExports, DelaysAreBound) {
  const std::string text = export_model(
      parse_ode_system("param T = 2\ndx/dt = -delay(x,T)\n", "d.ode"), "modelica");
  EXPECT_THAT(text, HasSubstr("delay(x, 2.0)"));
}

}  // namespace
}  // namespace lacuna::testing
