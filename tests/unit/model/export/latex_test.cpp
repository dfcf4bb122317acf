// SPDX-License-Identifier: MIT
#include "model/export/latex.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

std::string latex_of(const std::string& formula) {
  const std::string text =
      export_latex(parse_ode("input u\ndx/dt = " + formula + "\ndy/dt = 0\n", "x.ode"));
  const std::string begin = "\\dot{x} &= ";
  const std::size_t at = text.find(begin) + begin.size();
  return text.substr(at, text.find(" \\\\\n  \\dot{y}", at) - at);
}

TEST(ExportLatex, IsOneEquationALine) {
  const std::string text = export_latex(
      parse_ode("dx1/dt = -1e-5*x1*(theta-x1)^2 + 1\ndtheta/dt = sqrt(abs(x1))/x1 - asin(x1)\n",
                "x.ode"));
  EXPECT_EQ(
      text,
      "\\begin{align*}\n"
      "  \\dot{x_{1}} &= -10^{-5}\\,x_{1}\\,\\left(\\mathit{theta} - x_{1}\\right)^{2} + 1 "
      "\\\\\n"
      "  \\dot{\\mathit{theta}} &= \\frac{\\sqrt{\\left|x_{1}\\right|}}{x_{1}} - "
      "\\arcsin\\left(x_{1}\\right)\n"
      "\\end{align*}\n");
}

TEST(ExportLatex, ParenthesesAndSignsStandWhereTheyAreNeeded) {
  EXPECT_EQ(latex_of("-x"), "-x");
  EXPECT_EQ(latex_of("2.5e-7*x - 3"), "2.5\\cdot 10^{-7}\\,x - 3");
  EXPECT_EQ(latex_of("sin(x-(-y))"), "\\sin\\left(x - \\left(-y\\right)\\right)");
  EXPECT_EQ(latex_of("sin(x-(y+u))"), "\\sin\\left(x - \\left(y + u\\right)\\right)");
  EXPECT_EQ(latex_of("(x*u)^2"), "x^{2}\\,u^{2}");
  EXPECT_EQ(latex_of("exp(x)^-y"), "\\exp\\left(x\\right)^{-y}");
  EXPECT_EQ(latex_of("1e-5^y"), "\\left(10^{-5}\\right)^{y}");
  EXPECT_EQ(latex_of("3*2^y - log(x)"), "3\\cdot 2^{y} - \\ln\\left(x\\right)");
  EXPECT_EQ(latex_of("sign(u)*delay(u,0.5)"),
            "\\operatorname{sign}\\left(u\\right)\\,u(t-0.5)");
  EXPECT_EQ(latex_of("0"), "0");
}

TEST(ExportLatex, NamesAreLetters) {
  const std::string text = export_latex(parse_ode("d_/dt = _1\nd_1/dt = _1 - _\n", "x.ode"));
  EXPECT_THAT(text, ::testing::HasSubstr("\\dot{\\mathit{\\_}} &= \\mathit{\\_1}"));
  const std::string name(100, 'a');
  const std::string cut = export_latex(parse_ode("d" + name + "/dt = 1\n", "x.ode"));
  EXPECT_THAT(cut, ::testing::StartsWith("% Names that are others here:\n%   " + name +
                                         "\n%   is " + std::string(51, 'a') + ".\n"));
}

TEST(ExportLatex, LongSumsAndManyEquationsAreDivided) {
  std::string text = "input u\n";
  for (int k = 0; k < 100; ++k) text += "dx" + std::to_string(k) + "/dt = u\n";
  const std::string many = export_latex(parse_ode(text, "x.ode"));
  EXPECT_EQ(std::count(many.begin(), many.end(), '&'), 100);
  EXPECT_EQ(many.find("\\begin{align*}\n  \\dot{x_{40}}"), many.find("\\begin{align*}", 20));
  std::string sum = "u";
  for (int k = 2; k < 100; ++k) sum += " - u^" + std::to_string(k);
  EXPECT_THAT(latex_of(sum), ::testing::HasSubstr("\\\\\n  &\\quad{} - u^{"));
}

}  // namespace
}  // namespace lacuna
