// SPDX-License-Identifier: MIT
// Friction and polynomials as effects.
#include <gtest/gtest.h>

#include "effects/families.hpp"
#include "support/effect_forms.hpp"

namespace lacuna {
namespace {

using Forms = std::set<std::string>;
using support::candidate_of;
using support::candidates_of;
using support::forms_of;
using support::model_of_lines;
using support::oscillator_scope;
using support::plausible_with;
using support::reading_of;
using support::scope_of;

// Effects that oppose a motion, and effects on the size of a rate.
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

// A joint: dw/dt = 4 u - 9 sin(q) - 0.5 w.
Scope joint_scope() {
  return scope_of(model_of_lines(
      {{"q", {{"w", 1.0}}}, {"w", {{"u", 4.0}, {"sin(q)", -9.0}, {"w", -0.5}}}}, {"u"}));
}

TEST(LoadFriction, IsOfWhatDrivesWhatWeighsAndWhatTheGearCarries) {
  const Forms forms = forms_of<kLoadFriction>(joint_scope(), 1);
  for (const char* form : {"abs(4*u)*sign(w)", "abs(-9*sin(q))*sign(w)",
                           "abs(-9*sin(q)-4*u)*sign(w)", "abs(-9*sin(q)*ratio-4*u)*sign(w)",
                           "abs(-9*sin(q)-4*u)*exp(-abs(w/speed)^exponent)*sign(w)",
                           "(abs(-9*sin(q)-4*u)+base)*exp(-abs(w/speed)^exponent)*sign(w)"})
    EXPECT_TRUE(forms.contains(form)) << form;
  EXPECT_EQ(forms.size(), 9u);
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

// Coefficients that are functions of something: of a temperature, of time; and radiation.
/// A reaction whose rate may depend on a temperature; both are about 20 and swing by 1.
Scope reaction() {
  return scope_of(model_of_lines({{"c", {{"c", -0.1}, {"1", 0.1}}}, {"T", {{"T", -0.2}}}}, {}),
                  20.0);
}

TEST(ExponentialRate, IsATermTimesAnExponentialOfAnotherVariable) {
  EXPECT_EQ(forms_of<kExponentialRate>(reaction(), 0),
            (Forms{"c*(exp((T-20)/scale)-1)", "c*(exp((20-T)/scale)-1)"}));
  EXPECT_EQ(forms_of<kExponentialRate>(reaction(), 1),
            (Forms{"T*(exp((c-20)/scale)-1)", "T*(exp((20-c)/scale)-1)"}));
}

TEST(ExponentialRate, ChangesByAFactorThatARateCanChangeBy) {
  const Candidate rate =
      candidate_of<kExponentialRate>(reaction(), 0, "c*(exp((T-20)/scale)-1)");
  ASSERT_EQ(rate.shapes.size(), 1u);
  EXPECT_NEAR(rate.shapes[0].low, 2.0 / 12.0, 1e-3);  // T goes from 19 to 21
  EXPECT_NEAR(rate.shapes[0].high, 2.0 / 0.3, 1e-2);
}

TEST(ExponentialRate, IsReadFromItsOwnFormsOnly) {
  const Scope scope = reaction();
  const Candidate rate = candidate_of<kExponentialRate>(scope, 0, "c*(exp((T-20)/scale)-1)");
  const auto reading = reading_of<kExponentialRate>(scope, rate, -0.1);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->sentence, "rate c that changes exponentially with T");
  Candidate other = rate;
  other.form = parse_expression("c*(exp((T-20)/scale)-2)");
  EXPECT_FALSE(reading_of<kExponentialRate>(scope, other, -0.1));
}

TEST(PeriodicParameter, IsATermTimesATone) {
  Scope scope = reaction();
  EXPECT_EQ(forms_of<kPeriodicParameter>(scope, 0), Forms{});
  scope.modulations = {{{0, 0.5, 0.2}, parse_expression("c")},
                       {{0, 0.01, 0.2}, parse_expression("c")}};  // less than half a period
  const auto swinging = candidates_of<kPeriodicParameter>(scope, 0);
  ASSERT_EQ(swinging.size(), 1u);
  EXPECT_EQ(swinging[0].starts[0], (Vector{{0.5, 0.2}}));
  const auto reading = reading_of<kPeriodicParameter>(scope, swinging[0], 0.3);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->sentence, "coefficient of c that swings with one frequency");
  EXPECT_FALSE(reading_of<kPeriodicForcing>(scope, swinging[0], 0.3));
  EXPECT_EQ(forms_of<kPeriodicParameter>(scope, 1), Forms{});
}

TEST(Radiation, IsALossOfWhatStaysOnOneSideOfZero) {
  EXPECT_EQ(forms_of<kRadiation>(reaction(), 1), Forms{"(T+zero)^4"});
  const Scope mirrored = scope_of(model_of_lines({{"T", {{"T", -0.2}}}}, {}), -20.0);
  EXPECT_EQ(forms_of<kRadiation>(mirrored, 0), Forms{"(zero-T)^4"});
  EXPECT_EQ(forms_of<kRadiation>(oscillator_scope(), 1), Forms{});
  const Scope pushed = scope_of(model_of_lines({{"T", {{"u", 1.0}}}}, {"u"}), 20.0);
  EXPECT_EQ(forms_of<kRadiation>(pushed, 0), Forms{}) << "nothing is lost in proportion";
}

TEST(Radiation, TakesAwayAndHasAZero) {
  const Scope scope = reaction();
  const Candidate loss = candidate_of<kRadiation>(scope, 1, "(T+zero)^4");
  const Vector near = Vector::Constant(1, 10.0);
  EXPECT_TRUE(reading_of<kRadiation>(scope, loss, -1e-9, near));
  EXPECT_FALSE(reading_of<kRadiation>(scope, loss, 1e-9, near));
  EXPECT_FALSE(
      reading_of<kRadiation>(scope, loss, -1e-9, Vector::Constant(1, loss.shapes[0].high)));
}

TEST(ExponentialConduction, WithTheWidestScaleIsAQuadraticTerm) {
  const Scope scope = reaction();
  const Candidate junction = candidate_of<kExponentialConduction>(scope, 1, "exp(T/scale)-1");
  EXPECT_TRUE(reading_of<kExponentialConduction>(scope, junction, -1.0, Vector::Ones(1)));
  EXPECT_FALSE(reading_of<kExponentialConduction>(
      scope, junction, -1.0, Vector::Constant(1, junction.shapes[0].high)));
}

// Effects that are powers and products, and couplings.
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
