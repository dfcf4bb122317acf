// SPDX-License-Identifier: MIT
// Effects that are powers and products, and couplings.
#include <gtest/gtest.h>

#include "lacuna/effects/families.hpp"
#include "support/effect_forms.hpp"

namespace lacuna {
namespace {

using Forms = std::set<std::string>;
using support::candidate_of;
using support::forms_of;
using support::model_of_lines;
using support::oscillator_scope;
using support::plausible_with;
using support::reading_of;
using support::scope_of;

/// A product and an input in one equation, neither in the other.
Scope product() {
  return scope_of(model_of_lines({{"x", {{"y", -1.0}, {"x", -0.1}}},
                                  {"y", {{"x*y", 1.0}, {"u", 2.0}, {"x^2", 1.0}, {"1", 0.1}}}},
                                 {"u"}));
}

TEST(ConstantOffset, IsTheConstantOfAnEquationThatHasNone) {
  EXPECT_EQ(forms_of<kConstantOffset>(product(), 0), Forms{"1"});
  EXPECT_EQ(forms_of<kConstantOffset>(product(), 1), Forms{});
}

TEST(LinearTerm, IsWhatTheEquationHasNot) {
  EXPECT_EQ(forms_of<kLinearTerm>(product(), 0), Forms{"u"});
  EXPECT_EQ(forms_of<kLinearTerm>(product(), 1), (Forms{"x", "y"}));
}

/// A mixed tank: dT/dt = (2 q - q T)/h.
Scope mixed() {
  return scope_of(model_of_lines(
      {{"T", {{"q*h^-1", 2.0}, {"q*T*h^-1", -1.0}}}, {"h", {{"q", 1.0}}}}, {"q"}));
}

TEST(LinearTerm, IsDividedByWhatTheWholeEquationIs) {
  EXPECT_EQ(forms_of<kLinearTerm>(mixed(), 0), (Forms{"T", "h", "q", "h^-1*T"}));
  EXPECT_EQ(forms_of<kConstantOffset>(mixed(), 0), (Forms{"1", "h^-1"}));
  const auto sentence = [](const auto& reading) { return reading ? reading->sentence : ""; };
  EXPECT_EQ(sentence(reading_of<kLinearTerm>(
                mixed(), candidate_of<kLinearTerm>(mixed(), 0, "h^-1*T"), 1.0)),
            "linear term in T, with the h^-1 that all terms have");
  EXPECT_EQ(sentence(reading_of<kConstantOffset>(
                mixed(), candidate_of<kConstantOffset>(mixed(), 0, "h^-1"), 1.0)),
            "constant offset of dT/dt, with the h^-1 that all terms have");
  Candidate other = candidate_of<kLinearTerm>(mixed(), 0, "h^-1*T");
  other.equation = 1;
  EXPECT_FALSE(reading_of<kLinearTerm>(mixed(), other, 1.0)) << "dh/dt is divided by nothing";
}

TEST(LinearTerm, IsThePlainWord) {
  const Candidate path = candidate_of<kLinearTerm>(product(), 0, "u");
  EXPECT_EQ(reading_of<kLinearTerm>(product(), path, 1.0)->precedence, Precedence::Plain);
  EXPECT_EQ(reading_of<kLinearTerm>(product(), path, 1.0)->sentence, "linear term in u");
}

TEST(Powers, AreThoseThatTheEquationHasNot) {
  EXPECT_EQ(forms_of<kQuadraticTerm>(product(), 1), (Forms{"y^2", "u^2"}));
  EXPECT_EQ(forms_of<kCubicTerm>(product(), 0), (Forms{"x^3", "y^3", "u^3"}));
  EXPECT_EQ(forms_of<kHigherOrderTerm>(product(), 0),
            (Forms{"x^4", "x^5", "y^4", "y^5", "u^4", "u^5"}));
  const Forms cross = forms_of<kCrossTerm>(product(), 1);
  EXPECT_FALSE(cross.contains("x*y"));
  EXPECT_TRUE(cross.contains("x^2*y") && cross.contains("x*u"));
}

TEST(CubicTerm, OfAPositionIsAStiffness) {
  const Scope scope = oscillator_scope();
  const Candidate cube = candidate_of<kCubicTerm>(scope, 1, "q^3");
  EXPECT_EQ(reading_of<kCubicStiffness>(scope, cube, 1.0)->precedence, Precedence::Contextual);
  EXPECT_EQ(reading_of<kCubicTerm>(scope, cube, 1.0)->precedence, Precedence::Plain);
  EXPECT_FALSE(
      reading_of<kCubicStiffness>(scope, candidate_of<kCubicTerm>(scope, 1, "v^3"), 1.0));
  EXPECT_EQ(forms_of<kCubicStiffness>(oscillator_scope(), 1), Forms{"q^3"});
  EXPECT_EQ(forms_of<kCubicStiffness>(product(), 0), Forms{});
}

TEST(CrossTerm, IsAnyProductOfUpToThreeFactors) {
  const auto is_product = [](const std::string& form) {
    Candidate candidate;
    candidate.form = candidate.argument = parse_expression(form);
    return reading_of<kCrossTerm>(product(), candidate, 1.0, Vector(0)).has_value();
  };
  EXPECT_TRUE(is_product("x*u*y"));
  EXPECT_TRUE(is_product("u*x*u"));
  EXPECT_FALSE(is_product("x^3"));
  EXPECT_FALSE(is_product("x^2*y^2"));
  EXPECT_FALSE(is_product("t*x"));
}

TEST(Feedthrough, IsAnInputOrAFactor) {
  EXPECT_EQ(forms_of<kFeedthrough>(product(), 0), Forms{"u"});
  EXPECT_EQ(forms_of<kFeedthrough>(product(), 1), (Forms{"x", "y"}));
  const auto precedence = [](Index equation, const std::string& form) {
    return reading_of<kFeedthrough>(product(),
                                    candidate_of<kFeedthrough>(product(), equation, form), 1.0)
        ->precedence;
  };
  EXPECT_EQ(precedence(0, "u"), Precedence::Contextual);
  EXPECT_EQ(precedence(1, "x"), Precedence::Special) << "as well a linear term";
}

TEST(MissingCoupling, IsBetweenPartsOnly) {
  const Scope parts =
      scope_of(model_of_lines({{"x", {{"x", -1.0}}}, {"y", {{"y", -2.0}}}}, {}));
  EXPECT_EQ(forms_of<kMissingCoupling>(parts, 0), Forms{"y"});
  EXPECT_EQ(forms_of<kMissingCoupling>(product(), 0), Forms{});
  EXPECT_EQ(
      reading_of<kMissingCoupling>(parts, candidate_of<kMissingCoupling>(parts, 0, "y"), 1.0)
          ->precedence,
      Precedence::Contextual);
}

TEST(MissingCoupling, IsAnExchangeWhereNeitherStateActsByItself) {
  const Scope tanks = scope_of(
      model_of_lines({{"h", {{"sqrt(h)", -1.0}}}, {"g", {{"sqrt(h)", 1.0}, {"g", -1.0}}}}, {}),
      2.0);
  EXPECT_EQ(forms_of<kMissingCoupling>(tanks, 0), Forms{"g-h"});
  EXPECT_EQ(forms_of<kMissingCoupling>(tanks, 1), Forms{}) << "h alone says the same";
  const Candidate exchange = candidate_of<kMissingCoupling>(tanks, 0, "g-h");
  EXPECT_TRUE(plausible_with<kMissingCoupling>(tanks, exchange, 0.1));
  EXPECT_FALSE(plausible_with<kMissingCoupling>(tanks, exchange, -0.1));
}

TEST(Leakage, TakesAway) {
  const Scope tank = scope_of(model_of_lines({{"h", {{"u", 1.0}}}}, {"u"}), 2.0);
  EXPECT_EQ(forms_of<kLeakage>(tank, 0), (Forms{"h", "sqrt(max(h,0))"}));
  const Candidate hole = candidate_of<kLeakage>(tank, 0, "sqrt(max(h,0))");
  EXPECT_TRUE(plausible_with<kLeakage>(tank, hole, -0.5));
  EXPECT_FALSE(plausible_with<kLeakage>(tank, hole, 0.5));
  EXPECT_EQ(reading_of<kLeakage>(tank, candidate_of<kLeakage>(tank, 0, "h"), -0.5)->precedence,
            Precedence::Special);
  EXPECT_EQ(forms_of<kLeakage>(oscillator_scope(), 1), Forms{}) << "a velocity is not stored";
}

}  // namespace
}  // namespace lacuna
