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

TEST(LinearTerm, LeavesThePathOfAnInputToFeedthrough) {
  EXPECT_EQ(candidate_of<kLinearTerm>(product(), 0, "u").plainer, "feedthrough");
  EXPECT_EQ(candidate_of<kLinearTerm>(product(), 1, "x").plainer, std::nullopt);
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
  EXPECT_EQ(candidate_of<kCubicTerm>(oscillator_scope(), 1, "q^3").plainer, "cubic-stiffness");
  EXPECT_EQ(candidate_of<kCubicTerm>(oscillator_scope(), 1, "v^3").plainer, std::nullopt);
  EXPECT_EQ(forms_of<kCubicStiffness>(oscillator_scope(), 1), Forms{"q^3"});
  EXPECT_EQ(forms_of<kCubicStiffness>(product(), 0), Forms{});
}

TEST(Feedthrough, IsAnInputOrAFactor) {
  EXPECT_EQ(forms_of<kFeedthrough>(product(), 0), Forms{"u"});
  EXPECT_EQ(forms_of<kFeedthrough>(product(), 1), (Forms{"x", "y"}));
  EXPECT_EQ(candidate_of<kFeedthrough>(product(), 1, "x").plainer, "linear-term");
}

TEST(MissingCoupling, IsBetweenPartsOnly) {
  const Scope parts =
      scope_of(model_of_lines({{"x", {{"x", -1.0}}}, {"y", {{"y", -2.0}}}}, {}));
  EXPECT_EQ(forms_of<kMissingCoupling>(parts, 0), Forms{"y"});
  EXPECT_EQ(forms_of<kMissingCoupling>(product(), 0), Forms{});
  EXPECT_EQ(candidate_of<kLinearTerm>(parts, 0, "y").plainer, "missing-coupling");
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
  EXPECT_EQ(candidate_of<kLeakage>(tank, 0, "h").plainer, "linear-term");
  EXPECT_EQ(forms_of<kLeakage>(oscillator_scope(), 1), Forms{}) << "a velocity is not stored";
}

}  // namespace
}  // namespace lacuna
