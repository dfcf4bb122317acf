// SPDX-License-Identifier: MIT
#include "model/export/foreign_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "model/export/dialect.hpp"
#include "model/export/languages.hpp"
#include "model/export/latex.hpp"
#include "model/export/quoted_text.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> called(const std::vector<std::string>& names, const NameRules& rules) {
  const ForeignNames foreign = foreign_names(names, rules);
  std::vector<std::string> found;
  for (const std::string& name : names) found.push_back(foreign.at(name));
  return found;
}

TEST(ForeignNames, LongOnesAreShortAndStayApart) {
  const std::string a = std::string(200, 'a') + "1", b = std::string(200, 'a') + "2";
  EXPECT_THAT(called({a, b}, c_names()),
              ElementsAre(std::string(51, 'a'), std::string(51, 'a') + "_"));
}

TEST(ForeignNames, OfManyThatCollideAreFoundAtOnce) {
  std::vector<std::string> names;
  for (int i = 0; i < 100000; ++i) names.push_back(std::string(80, 'a') + std::to_string(i));
  EXPECT_EQ(foreign_names(names, c_names()).at(names.back()), std::string(51, 'a') + "_99999");
}

/// Whatever the names are: as many, all different, none of them a word, all of the shape.
TEST(ForeignNames, RandomNamesStayApart) {
  Random random(7);
  for (const NameRules* rules :
       {&c_names(), &python_names(), &matlab_names(), &modelica_names(), &spice_names()}) {
    std::vector<std::string> words(rules->words.begin(), rules->words.end());
    for (const char* more :
         {"x", "X", "x_", "x_2", "_", "__", "\xc3\xa9", "lacuna_", "M_", "a b"})
      words.emplace_back(more);
    for (int run = 0; run < 500; ++run) {
      std::set<std::string> names;
      for (std::uint64_t i = random.below(9); i > 0; --i) {
        std::string name = words[random.below(words.size())];
        if (random.below(3) == 0) name += words[random.below(words.size())];
        if (random.below(4) == 0) name += "_";
        if (random.below(4) == 0 && !name.empty())
          name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
        if (random.below(50) == 0) name.append(60, 'q');
        names.insert(name);
      }
      std::set<std::string> seen;
      for (const auto& [name, foreign] :
           foreign_names(std::vector<std::string>(names.begin(), names.end()), *rules)) {
        std::string key = foreign;
        if (rules->case_blind)
          for (char& c : key)
            c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        EXPECT_TRUE(seen.insert(key).second) << foreign;
        EXPECT_FALSE(rules->words.contains(key)) << foreign;
        EXPECT_THAT(foreign, ::testing::MatchesRegex("[a-zA-Z][a-zA-Z0-9_]*"));
        EXPECT_EQ(foreign.find("__"), std::string::npos) << foreign;
        EXPECT_LE(foreign.size(), 63u);
      }
      EXPECT_EQ(seen.size(), names.size());
    }
  }
}

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

/// Ends of comments and lines, continuations, escapes, directives, encodings and modelines.
TEST(QuotedText, MakesNothingOfAnyLanguage) {
  EXPECT_EQ(quoted_text("*/"), "*<U+002F>");
  EXPECT_EQ(quoted_text("/*"), "/<U+002A>");
  EXPECT_EQ(quoted_text("^^5c"), "^<U+005E>5c");
  EXPECT_EQ(quoted_text("-*-"), "-<U+002A>-");
  for (const char* text : {"\n", "\r", "\v", "\f", "\t", "\xc2\x85", "\xe2\x80\xa8",
                           "\\", "\"", "'",  "{",  "}",  "[",        "]",
                           "?",  ":",  "=",  ";",  "#",  "$",        "&",
                           "@",  "`",  "~",  "!",  "<",  ">",        "|"}) {
    const std::string safe = quoted_text(text);
    EXPECT_TRUE(safe.starts_with("<U+")) << text;
    EXPECT_EQ(quoted_text("a" + std::string(text)), "a" + safe);
  }
}

TEST(QuotedText, CutsOffLongTexts) {
  EXPECT_EQ(quoted_text(std::string(101, 'a')), std::string(101, 'a'));
  EXPECT_EQ(quoted_text(std::string(1000, 'a')), std::string(101, 'a') + "...");
}

TEST(QuotedText, RandomBytesBecomeAsciiThatTellsThemApart) {
  Random random(3);
  const std::string marks = " _.,()+-%*/^<>U0x";
  for (int run = 0; run < 20000; ++run) {
    std::string a, b;
    for (std::string* text : {&a, &b})
      for (std::uint64_t i = random.below(5); i > 0; --i)
        *text += random.below(2) == 0 ? marks[random.below(marks.size())]
                                      : static_cast<char>(random.below(256));
    const std::string safe = quoted_text(a);
    EXPECT_TRUE(
        std::all_of(safe.begin(), safe.end(), [](char c) { return c >= ' ' && c <= '~'; }));
    EXPECT_EQ(safe.find_first_of("\\\"'{}[]?:=;#$&@`~!|"), std::string::npos);
    EXPECT_EQ(safe == quoted_text(b), a == b) << safe;
  }
}

TEST(CommentLines, AreBrokenAtBlanks) {
  EXPECT_EQ(comment_lines("// ", "a b"), "// a b\n");
  const std::string word(40, 'x');
  EXPECT_EQ(comment_lines("% ", word + " " + word + " " + word),
            "% " + word + " " + word + "\n%   " + word + "\n");
  EXPECT_EQ(comment_lines("# ", std::string(200, 'y')), "# " + std::string(200, 'y') + "\n");
}

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
