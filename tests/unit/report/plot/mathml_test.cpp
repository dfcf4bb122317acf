// SPDX-License-Identifier: MIT
#include "report/plot/mathml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "report/plot/scale.hpp"
#include "support/well_formed.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::string math(const std::string& formula) {
  const std::string text = to_mathml(parse_expression(formula)).string();
  EXPECT_EQ(support::first_fault(text), "") << formula;
  return text;
}

TEST(MathMl, HasFractionsRootsAndPowers) {
  EXPECT_THAT(math("x/y"),
              HasSubstr("<mfrac><mrow><mi>x</mi></mrow><mrow><mi>y</mi></mrow></mfrac>"));
  EXPECT_THAT(math("sqrt(x)"), HasSubstr("<msqrt><mi>x</mi></msqrt>"));
  EXPECT_THAT(
      math("x1^2"),
      HasSubstr("<msup><msub><mi>x</mi><mn>1</mn></msub><mrow><mn>2</mn></mrow></msup>"));
}

TEST(MathMl, BracketsStandWhereTheyAreNeeded) {
  EXPECT_THAT(math("(x+y)*z"), HasSubstr("<mo>(</mo>"));
  EXPECT_THAT(math("x+y*z"), Not(HasSubstr("<mo>(</mo>")));
  EXPECT_THAT(math("x-(y-z)"), HasSubstr("<mo>(</mo>"));
  EXPECT_THAT(math("(x+y)^2"), HasSubstr("<mo>(</mo>"));
}

TEST(MathMl, KnowsTheNamesOfTextbooks) {
  EXPECT_THAT(math("sign(w)"), HasSubstr("<mi>sgn</mi>"));
  EXPECT_THAT(math("log(w)"), HasSubstr("<mi>ln</mi>"));
  EXPECT_THAT(math("abs(w)"), HasSubstr("<mo>|</mo><mi>w</mi><mo>|</mo>"));
  EXPECT_THAT(math("delay(x,0.5)"), HasSubstr("<mi>t</mi><mo>\u2212</mo><mn>0.5</mn>"));
  EXPECT_THAT(math("2.5e-7*x"), HasSubstr("<msup><mn>10</mn><mn>-7</mn></msup>"));
}

TEST(MathMl, EquationsMarkWhatIsNewAndRoundByTheInterval) {
  const Variables variables{{"x", "v"}, {}};
  const OdeModel model(
      {{"x", "m"}, {"v", "m/s"}}, {},
      {{{Term::parse("v", variables), 1.0}},
       {{Term::parse("x", variables), -2.000123456, 0.01, std::array{-2.02, -1.98}},
        {Term::parse("sign(v)", variables), -0.4}}});
  const std::string text = equations_mathml(model, {{1, "sign(v)"}}).string();
  EXPECT_EQ(support::first_fault(text), "");
  EXPECT_THAT(text, HasSubstr("<mn>2</mn>"));
  EXPECT_THAT(text, Not(HasSubstr("2.000123")));
  const std::size_t fresh = text.find("<span class=\"term new\">");
  ASSERT_NE(fresh, std::string::npos);
  EXPECT_LT(fresh, text.find("sgn"));
  EXPECT_THAT(text, Not(HasSubstr("<mn>1</mn>"))) << "a coefficient of 1 is not written";
}

/// Pieces of the term of an equation between which a line may end.
int pieces_of(const std::string& formula) {
  const Variables variables{{"x", "v"}, {}};
  const OdeModel model({{"x", ""}, {"v", ""}}, {}, {{{Term::parse(formula, variables), 2.0}}, {}});
  const std::string text = equations_mathml(model).string();
  const std::size_t begin = text.find("class=\"term\""), end = text.find("</span>", begin);
  const std::string term = text.substr(begin, end - begin);
  EXPECT_EQ(support::first_fault("<p><span " + term + "</span></p>"), "") << formula;
  int count = 0;
  for (std::size_t at = term.find("<math"); at != std::string::npos;
       at = term.find("<math", at + 1))
    ++count;
  return count;
}

TEST(MathMl, OnlyTermsThatAreLongerThanALineBreak) {
  EXPECT_EQ(pieces_of("x*v*sin(x)*exp(-v^2)"), 1);
  EXPECT_EQ(pieces_of("(x+v+x*v+x^2)/(1+x^2+v^2+x*v)"), 1) << "a fraction is as long as a part";
  EXPECT_GT(pieces_of("sin(x)*cos(v)*tanh(x/0.01)*exp(-(v/0.2)^2)"), 1);
  EXPECT_GT(pieces_of("(0.1+2.3*x-4.5*x^2+6.7*x^3-8.9*x^4)/(1+v)"), 1);
  EXPECT_GT(pieces_of("sqrt(0.1+2.3*x+4.5*x^2+6.7*x^4+8.9*x^6)"), 1);
  EXPECT_GT(pieces_of("(0.1+2.3*x+4.5*x^2+6.7*x^4+8.9*x^6)^2"), 1);
}

TEST(MathMl, ABrokenTermKeepsItsBrackets) {
  const Variables variables{{"x", "v"}, {}};
  const OdeModel model(
      {{"x", ""}, {"v", ""}}, {},
      {{{Term::parse("abs(x-(v-x-1.234)-0.567*v)*sin(x+v*(x-v-0.123456789))", variables), 1.0}},
       {}});
  const std::string text = equations_mathml(model).string();
  const auto count = [&](const std::string& part) {
    int found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++found;
    return found;
  };
  EXPECT_EQ(count("<mo>(</mo>"), 3);
  EXPECT_EQ(count("<mo>)</mo>"), 3);
  EXPECT_EQ(count("<mo>|</mo>"), 2);
  EXPECT_EQ(count("0.1235"), 1) << "numbers of a formula have four digits";
}

TEST(MathMl, AnEmptyEquationIsZero) {
  const OdeModel model({{"x", ""}}, {}, {{}});
  EXPECT_THAT(equations_mathml(model).string(), HasSubstr("<mn>0</mn>"));
}

TEST(MathMl, NextValuesOfMapsHaveAnIndex) {
  const OdeModel map = OdeModel({{"x", ""}}, {}, {{}}).with_evolution(Evolution::Map);
  EXPECT_THAT(equations_mathml(map).string(),
              HasSubstr("<msub><mrow><mi>x</mi></mrow><mrow><mi>n</mi>"));
  EXPECT_THAT(equations_mathml(map).string(), Not(HasSubstr("mfrac")));
}

std::vector<std::string> labels(const Scale& scale, int count) {
  std::vector<std::string> all;
  for (const Tick& tick : ticks_of(scale, count)) all.push_back(tick.label);
  return all;
}

TEST(Scale, HoldsAllFiniteValues) {
  const Vector a = Eigen::Vector3d(1.0, NAN, 3.0), b = Eigen::Vector2d(-1.0, INFINITY);
  const Scale scale = scale_of({&a, &b});
  EXPECT_DOUBLE_EQ(scale.low, -1.0 - 0.16);
  EXPECT_DOUBLE_EQ(scale.high, 3.0 + 0.16);
  EXPECT_DOUBLE_EQ(scale.part(1.0), 0.5);
}

TEST(Ticks, AreRoundAndInside) {
  EXPECT_THAT(labels({-0.3, 1.1, false}, 6), ElementsAre("0", "0.5", "1"));
  EXPECT_THAT(labels({0.0, 1040.0, false}, 5), ElementsAre("0", "500", "1000"));
  EXPECT_THAT(labels({1e-9, 3e-9, false}, 2), ElementsAre("1e-09", "2e-09", "3e-09"));
  EXPECT_THAT(labels({0.5, 2000.0, true}, 5), ElementsAre("1", "10", "100", "1e+03"));
}

TEST(Ticks, TellNeighboursOfALargeOffsetApart) {
  const auto all = labels({1e6, 1e6 + 0.4, false}, 4);
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
}

TEST(Ticks, OfLogarithmsAreEveryFewDecades) {
  const std::vector<Tick> ticks = ticks_of({1e-3, 1e9, true}, 5);
  ASSERT_EQ(ticks.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(std::log10(ticks[i].value), 3.0 * static_cast<double>(i) - 3.0, 1e-12);
}

TEST(ShownSamples, KeepTheExtremesOfEveryColumn) {
  const Index n = 100000, columns = 50;
  const Vector x = Vector::LinSpaced(n, 0.0, 1.0);
  Vector y = (200.0 * x.array()).sin();
  y[31234] = 9.0;
  y[31240] = -9.0;
  const auto shown = shown_samples(x, y, {0.0, 1.0, false}, columns);
  EXPECT_LE(shown.size(), 4u * (columns + 1));
  EXPECT_TRUE(std::is_sorted(shown.begin(), shown.end()));
  for (Index c = 0; c < columns; ++c) {
    const Index begin = c * n / columns, end = (c + 1) * n / columns;
    double least = 1e9, all_least = y.segment(begin, end - begin).minCoeff();
    double most = -1e9, all_most = y.segment(begin, end - begin).maxCoeff();
    for (const Index i : shown)
      if (i >= begin - 1 && i <= end) {
        least = std::min(least, y[i]);
        most = std::max(most, y[i]);
      }
    EXPECT_LE(least, all_least) << c;
    EXPECT_GE(most, all_most) << c;
  }
}

TEST(ShownSamples, KeepAGap) {
  const Vector x = Vector::LinSpaced(1000, 0.0, 1.0);
  Vector y = Vector::Ones(1000);
  y.segment(400, 100).setConstant(std::numeric_limits<double>::quiet_NaN());
  int gaps = 0;
  for (const Index i : shown_samples(x, y, {0.0, 1.0, false}, 20)) gaps += std::isnan(y[i]);
  EXPECT_EQ(gaps, 1);
}

TEST(ShownSamples, OfAnOrbitAreSpreadOverIt) {
  const Vector t = Vector::LinSpaced(10000, 0.0, 100.0);
  const auto shown = shown_samples(t.array().cos(), t.array().sin(), {-1.0, 1.0, false}, 100);
  EXPECT_LE(shown.size(), 402u);
  EXPECT_EQ(shown.front(), 0);
  EXPECT_EQ(shown.back(), 9999);
}

}  // namespace
}  // namespace lacuna
