// SPDX-License-Identifier: MIT
// Effects that oppose a motion.
#include <gtest/gtest.h>

#include "lacuna/effects/families.hpp"
#include "support/effect_forms.hpp"

namespace lacuna {
namespace {

using Forms = std::set<std::string>;
using support::candidate_of;
using support::forms_of;
using support::oscillator_scope;
using support::plausible_with;

TEST(CoulombFriction, IsSharpOrSmooth) {
  EXPECT_EQ(forms_of<kCoulombFriction>(oscillator_scope(), 1),
            (Forms{"sign(v)", "tanh(v/width)"}));
  const Candidate smooth =
      candidate_of<kCoulombFriction>(oscillator_scope(), 1, "tanh(v/width)");
  ASSERT_EQ(smooth.shapes.size(), 1u);
  EXPECT_EQ(smooth.shapes[0].unit, "m/s");
}

TEST(CoulombFriction, IsThereAsSoonAsSomethingMoves) {
  const Scope scope = oscillator_scope();
  const double fastest = scope.range_of(parse_expression("v")).magnitude();
  const Candidate smooth = candidate_of<kCoulombFriction>(scope, 1, "tanh(v/width)");
  const auto is_friction = [&](double width) {
    const Vector shapes = Vector::Constant(1, width * fastest);
    return support::reading_of<kCoulombFriction>(scope, smooth, -0.4, shapes).has_value();
  };
  EXPECT_TRUE(is_friction(0.09));
  EXPECT_FALSE(is_friction(0.11)) << "a saturation";
}

TEST(CoulombFriction, NeedsAVelocityOfBothSigns) {
  Scope scope = oscillator_scope();
  scope.variables[1].low = 0.1;
  EXPECT_EQ(forms_of<kCoulombFriction>(scope, 1), Forms{});
  EXPECT_EQ(forms_of<kQuadraticDrag>(scope, 1), Forms{});
  EXPECT_EQ(forms_of<kStribeckFriction>(scope, 1), Forms{});
}

TEST(CoulombFriction, ActsBetweenPlacesToo) {
  const Scope belt =
      support::scope_of(support::model_of_lines({{"v", {{"v", -1.0}, {"u", 1.0}}}}, {"u"}));
  EXPECT_TRUE(forms_of<kCoulombFriction>(belt, 0).contains("sign(v-u)"));
}

TEST(CoulombFriction, IsFeltByBodiesThatMoveTogether) {
  const Scope cart = support::scope_of(support::model_of_lines(
      {{"x", {{"v", 1.0}}}, {"v", {{"q", 2.0}}}, {"q", {{"w", 1.0}}}, {"w", {{"q", -9.0}}}},
      {}));
  const Candidate far = candidate_of<kCoulombFriction>(cart, 3, "sign(v)");
  EXPECT_EQ(support::reading_of<kCoulombFriction>(cart, far, 0.4)->sentence,
            "dry friction of v");
  EXPECT_TRUE(plausible_with<kCoulombFriction>(cart, far, 0.4)) << "either sign";
  EXPECT_TRUE(forms_of<kQuadraticDrag>(cart, 3).contains("v*abs(v)"));
  EXPECT_FALSE(forms_of<kCoulombFriction>(cart, 0).contains("sign(w)")) << "no velocity";
}

TEST(Friction, OpposesTheMotion) {
  const Scope scope = oscillator_scope();
  const Candidate dry = candidate_of<kCoulombFriction>(scope, 1, "sign(v)");
  EXPECT_TRUE(plausible_with<kCoulombFriction>(scope, dry, -0.4));
  EXPECT_FALSE(plausible_with<kCoulombFriction>(scope, dry, 0.4));
  const Candidate drag = candidate_of<kQuadraticDrag>(scope, 1, "v*abs(v)");
  EXPECT_FALSE(plausible_with<kQuadraticDrag>(scope, drag, 0.4));
}

TEST(StribeckFriction, OpposesTheMotion) {
  const Candidate candidate = candidate_of<kStribeckFriction>(
      oscillator_scope(), 1, "(1+rise*exp(-(v/speed)^2))*sign(v)");
  EXPECT_EQ(candidate.shapes.size(), 2u);
  EXPECT_TRUE(plausible_with<kStribeckFriction>(oscillator_scope(), candidate, -0.4));
  EXPECT_FALSE(plausible_with<kStribeckFriction>(oscillator_scope(), candidate, 0.4));
}

TEST(StribeckFriction, MayReverseSmoothly) {
  const Candidate candidate = candidate_of<kStribeckFriction>(
      oscillator_scope(), 1, "(1+rise*exp(-(v/speed)^2))*tanh(v/width)");
  ASSERT_EQ(candidate.shapes.size(), 3u);
  EXPECT_LT(candidate.shapes[2].high, candidate.shapes[1].high) << "the rise is still seen";
  for (const Vector& start : candidate.starts) EXPECT_EQ(start.size(), 3);
}

}  // namespace
}  // namespace lacuna
