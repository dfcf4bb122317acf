// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/term.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

using Exponents = std::vector<int>;

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

TEST(TermLibrary, CompilesAllTermsIntoOneProgram) {
  const TermLibrary library{kPlane, {term("1"), term("x*y"), term("sin(u)"), term("1/y")}};
  EXPECT_EQ(library.size(), 4);
  EXPECT_EQ(library.names(), (std::vector<std::string>{"1", "x*y", "sin(u)", "y^-1"}));
  const Program program = library.compile();
  Program::Workspace workspace;
  const double slots[4] = {3.0, 2.0, 0.0, 0.0};
  double out[4];
  program.evaluate(slots, out, workspace);
  EXPECT_THAT(out, ::testing::ElementsAre(1.0, 6.0, 0.0, 0.5));
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

}  // namespace
}  // namespace lacuna
