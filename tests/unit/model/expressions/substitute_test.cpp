// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/expressions/expression.hpp"
#include "lacuna/model/expressions/program.hpp"

namespace lacuna {
namespace {

Expression parsed(const std::string& text) { return parse_expression(text); }

TEST(Substitute, PutsExpressionsInPlaceOfNamesAllAtOnce) {
  EXPECT_EQ(substitute(parsed("x*y+sin(x)"), {{"x", parsed("y-1")}, {"y", parsed("x^2")}}),
            parsed("(y-1)*x^2+sin(y-1)"));
  EXPECT_EQ(substitute(parsed("x*y"), {{"z", parsed("1")}}), parsed("x*y"));
}

TEST(Substitute, NumbersGiveWhatWouldHaveBeenWritten) {
  EXPECT_EQ(substitute(parsed("clip(x,-a,a)*1e5"), {{"a", Expression::number(0.3)}}),
            parsed("clip(x,-0.3,0.3)*1e5"));
  EXPECT_EQ(substitute(parsed("x-a"), {{"a", Expression::number(-1.5)}}), parsed("x-(-1.5)"));
}

TEST(Substitute, ADelayIsBoundByANumber) {
  const Expression late = parsed("delay(x,T)-x");
  EXPECT_EQ(late.variables(), (std::set<std::string>{"T", "x"}));
  EXPECT_EQ(substitute(late, {{"T", Expression::number(0.25)}}), parsed("delay(x,0.25)-x"));
  EXPECT_EQ(substitute(late, {{"T", Expression::number(0.0)}}), parsed("x-x"));
  EXPECT_EQ(substitute(late, {{"T", parsed("2*S")}}), parsed("delay(x,2*S)-x"));
  EXPECT_THROW(substitute(late, {{"T", Expression::number(-1.0)}}), ModelError);
}

TEST(Substitute, WhatStandsInADelayIsDelayed) {
  EXPECT_EQ(substitute(parsed("delay(x,0.5)"), {{"x", parsed("u*delay(v,1)+2")}}),
            parsed("delay(u,0.5)*delay(v,1.5)+2"));
  EXPECT_EQ(delay(parsed("x*y"), parsed("T")), parsed("delay(x,T)*delay(y,T)"));
  EXPECT_EQ(delay(parsed("t"), parsed("T")), parsed("t-T"));
}

TEST(Substitute, DelaysWithoutANumberReadBackAsTheyAreWritten) {
  for (const std::string text : {"delay(x,T)", "x*delay(y,2*T+1)", "delay(x,0.5+T)"}) {
    EXPECT_EQ(parsed(text).to_string(), text);
    EXPECT_EQ(parsed(parsed(text).to_string()), parsed(text));
  }
  EXPECT_EQ(parsed("delay(x,T)").hash(), parsed("delay(x,T)").hash());
  EXPECT_FALSE(parsed("delay(x,T)") == parsed("delay(x,S)"));
}

TEST(Substitute, NothingIsComputedBeforeADelayHasANumber) {
  const Expression late = parsed("delay(x,T)");
  try {
    const Program program({&late, 1}, {{"x", "T"}, {}});
    FAIL() << "the delay is not known";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("delay(x,T)"), std::string::npos) << error.what();
  }
}

TEST(Substitute, DerivativesHoldDelaysFixed) {
  EXPECT_EQ(differentiate(parsed("x*delay(x,T)"), "x"), parsed("delay(x,T)"));
  EXPECT_THROW(differentiate(parsed("x*delay(x,T)"), "T"), ModelError);
}

TEST(Contains, FindsAnOperationAnywhere) {
  EXPECT_TRUE(contains(parsed("1+sin(2*delay(x,1))"), Operation::Delay));
  EXPECT_FALSE(contains(parsed("1+sin(2*x)"), Operation::Delay));
}

}  // namespace
}  // namespace lacuna
