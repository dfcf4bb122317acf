// SPDX-License-Identifier: MIT
// Effects that bend or limit a characteristic.
#include <gtest/gtest.h>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"
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

TEST(DeadZone, LeavesNoSlopeInside) {
  // The nominal coefficient of q is -4.
  const Scope scope = oscillator_scope();
  const Candidate zone = candidate_of<kDeadZone>(scope, 1, "clip(q,-edge,edge)");
  EXPECT_TRUE(plausible_with<kDeadZone>(scope, zone, 4.0));
  EXPECT_FALSE(plausible_with<kDeadZone>(scope, zone, 2.0));
  EXPECT_FALSE(plausible_with<kDeadZone>(scope, zone, -4.0));
}

TEST(Saturation, LeavesNoSlopeOutside) {
  const Scope scope = oscillator_scope();
  const Candidate limit = candidate_of<kSaturation>(scope, 1, "F-clip(F,-limit,limit)");
  EXPECT_TRUE(plausible_with<kSaturation>(scope, limit, -1.0));
  EXPECT_FALSE(plausible_with<kSaturation>(scope, limit, -0.5));
  EXPECT_EQ(reading_of<kSaturation>(scope, limit, -1.0)->sentence, "saturation of F");
}

TEST(Saturation, OfAnActionOfItsOwnBesideATerm) {
  // The nominal coefficient of q is -4; 60 tanh(q/0.05) has the slope 1200.
  const Scope scope = oscillator_scope();
  const Candidate steep = candidate_of<kSaturation>(scope, 1, "tanh(q/limit)");
  const auto steep_one = reading_of<kSaturation>(scope, steep, 60.0, Vector::Constant(1, 0.05));
  ASSERT_TRUE(steep_one.has_value());
  EXPECT_EQ(steep_one->sentence, "action of q that saturates");
  EXPECT_FALSE(
      reading_of<kSaturation>(scope, steep, 0.5, Vector::Constant(1, 0.25)).has_value())
      << "most of the slope is left outside";
  EXPECT_LT(steep.shapes[0].high, scope.state(0).magnitude());
  EXPECT_TRUE(
      plausible_with<kSaturation>(scope, candidate_of<kSaturation>(scope, 1, "sign(q)"), -2.0));
  EXPECT_FALSE(
      plausible_with<kSaturation>(scope, candidate_of<kSaturation>(scope, 1, "sign(v)"), 2.0))
      << "a speed that pushes";
}

TEST(OneSidedStop, AndOthersAreSoughtWhereHardlyAnythingActs) {
  const Scope scope = oscillator_scope();
  const Candidate stop = candidate_of<kOneSidedStop>(scope, 1, "max(q-edge,0)");
  EXPECT_GT(stop.starts.back()[0], scope.state(0).quantile(0.98));
  EXPECT_GE(stop.shapes[0].high, scope.state(0).quantile(0.985));
  const Candidate zone = candidate_of<kDeadZone>(scope, 1, "clip(q,-edge,edge)");
  EXPECT_LT(zone.shapes[0].low, 0.01 * scope.state(0).magnitude());
}

TEST(CoulombFriction, IsABendAtStandstillThatOpposesTheMotion) {
  // The speed is within +-2; the damping of the nominal model has the coefficient -0.2.
  const Scope scope = oscillator_scope();
  const auto is_friction = [&](const std::string& form, double coefficient, double edge) {
    const Candidate candidate = candidate_of<kPiecewiseLinear>(scope, 1, form);
    return reading_of<kCoulombFriction>(scope, candidate, coefficient,
                                        Vector::Constant(1, edge))
        .has_value();
  };
  EXPECT_TRUE(is_friction("clip(v,-edge,edge)", -5.0, 0.05));
  EXPECT_FALSE(is_friction("clip(v,-edge,edge)", -5.0, 1.0)) << "not at once";
  EXPECT_FALSE(is_friction("clip(v,-edge,edge)", 5.0, 0.05)) << "it pushes";
  EXPECT_FALSE(is_friction("clip(v,-edge,edge)", 0.2, 0.05)) << "nothing acts inside";
  EXPECT_FALSE(is_friction("clip(F,-edge,edge)", -5.0, 0.01)) << "a switch, not friction";
}

TEST(CoulombFriction, GoesBeforeOtherWordsForTheSameForm) {
  const Scope scope = oscillator_scope();
  const Candidate bends = candidate_of<kPiecewiseLinear>(scope, 1, "clip(v,-edge,edge)");
  const Vector edge = Vector::Constant(1, 0.05);
  const auto friction = reading_of<kCoulombFriction>(scope, bends, -0.5, edge);
  const auto bent = reading_of<kPiecewiseLinear>(scope, bends, -0.5, edge);
  ASSERT_TRUE(friction && bent);
  EXPECT_LT(friction->precedence, bent->precedence);
}

TEST(Saturation, OfWhatTheEquationHasNot) {
  const Scope scope = scope_of(model_of_lines({{"x", {{"x", -1.0}}}, {"y", {{"x", 1.0}}}}, {}));
  EXPECT_TRUE(forms_of<kSaturation>(scope, 0).contains("clip(y,-limit,limit)"));
}

TEST(Saturation, CopesWithRecordsThatAreMostlyZero) {
  Dataset data = support::oscillator_record();
  data.trajectories[0].inputs.topRows(900).setZero();
  const Scope scope = make_scope(support::oscillator(), data, Vector::Constant(2, 0.01));
  const Candidate limit = candidate_of<kSaturation>(scope, 1, "F-clip(F,-limit,limit)");
  EXPECT_GT(limit.shapes[0].low, 0.0);
  for (const Vector& start : limit.starts) EXPECT_GE(start[0], limit.shapes[0].low);
}

TEST(OneSidedStop, PushesAPositionBack) {
  const Scope scope = oscillator_scope();
  const Candidate upper = candidate_of<kOneSidedStop>(scope, 1, "max(q-edge,0)");
  EXPECT_TRUE(plausible_with<kOneSidedStop>(scope, upper, -50.0));
  EXPECT_FALSE(plausible_with<kOneSidedStop>(scope, upper, 50.0));
  const Candidate lower = candidate_of<kOneSidedStop>(scope, 1, "min(q-edge,0)");
  EXPECT_FALSE(plausible_with<kOneSidedStop>(scope, lower, 50.0));
}

TEST(OneSidedStop, IsSoughtWhereverSamplesLieOnEitherSide) {
  const Scope scope = oscillator_scope();
  const Candidate upper = candidate_of<kOneSidedStop>(scope, 1, "max(q-edge,0)");
  const auto q = scope.samples.col(0).array();
  for (const double edge : {upper.shapes[0].low, upper.shapes[0].high}) {
    EXPECT_GT((q > edge).count(), 5) << edge;
    EXPECT_GT((q < edge).count(), 5) << edge;
  }
}

TEST(OneSidedStop, StandsBetweenTwoPlaces) {
  const Scope pair =
      scope_of(model_of_lines({{"a", {{"a", -2.0}, {"b", 2.0}}}, {"b", {{"b", -1.0}}}}, {}));
  EXPECT_TRUE(forms_of<kOneSidedStop>(pair, 0).contains("max(a-b-edge,0)"));
  EXPECT_FALSE(forms_of<kOneSidedStop>(pair, 1).contains("max(a-b-edge,0)"));
}

TEST(PiecewiseLinear, HasOneBendOrTwo) {
  const Forms forms = forms_of<kPiecewiseLinear>(oscillator_scope(), 1);
  EXPECT_TRUE(forms.contains("max(q-edge,0)"));
  EXPECT_TRUE(forms.contains("clip(q,-edge,edge)"));
  EXPECT_FALSE(forms.contains("abs(q)")) << "with q in the equation the bend covers it";
}

TEST(PiecewiseLinear, HasTwoSlopesOrABendInTheMiddle) {
  const Scope scope = oscillator_scope();
  const Candidate bends = candidate_of<kPiecewiseLinear>(scope, 1, "clip(q,-edge,edge)");
  EXPECT_TRUE(plausible_with<kPiecewiseLinear>(scope, bends, 1.5));
  EXPECT_FALSE(plausible_with<kPiecewiseLinear>(scope, bends, 4.0)) << "nothing inside";
  const Candidate bend = candidate_of<kPiecewiseLinear>(scope, 1, "max(q-edge,0)");
  EXPECT_FALSE(plausible_with<kPiecewiseLinear>(scope, bend, -5.0)) << "at the rim";
  EXPECT_TRUE(plausible_with<kPiecewiseLinear>(scope, bend, 5.0)) << "no stop pulls";
}

TEST(Bends, SlopesAreThoseOfNominalTermAndFormTogether) {
  const Scope scope = oscillator_scope();
  const NamingOptions options;
  const auto bend = [&](const std::string& form) {
    const Candidate candidate = candidate_of<kSaturation>(scope, 1, form);
    return *bend_of(
        {candidate, candidate.starts.front(), 3.0, 0.1, scope.model, scope, options});
  };
  // The nominal coefficient of q is -4.
  EXPECT_EQ(bend("q-clip(q,-limit,limit)").inside, -4.0);
  EXPECT_EQ(bend("q-clip(q,-limit,limit)").outside, -1.0);
  EXPECT_FALSE(bend("q-limit*tanh(q/limit)").sharp);
}

TEST(Bends, SlopesAgreeWithinAFifthOrThreeErrors) {
  const NamingOptions options;
  EXPECT_TRUE(is_flat_inside({1.5, 10.0, 1.0, 0.01, true}, options));
  EXPECT_FALSE(is_flat_inside({2.5, 10.0, 1.0, 0.01, true}, options));
  EXPECT_TRUE(is_flat_inside({2.5, 10.0, 1.0, 1.0, true}, options));
  EXPECT_FALSE(is_flat_inside({10.0, 1.0, 1.0, 0.01, true}, options));
  EXPECT_TRUE(is_flat_outside({10.0, 1.0, 1.0, 0.01, true}, options));
}

TEST(Overflow, LosesHereAndGainsThere) {
  const Scope tanks = scope_of(
      model_of_lines({{"a", {{"u", 1.0}, {"a", -1.0}}}, {"b", {{"a", 0.5}}}}, {"u"}), 2.0);
  const Candidate lost = candidate_of<kOverflow>(tanks, 0, "max(a-edge,0)");
  EXPECT_TRUE(plausible_with<kOverflow>(tanks, lost, -1.0));
  EXPECT_FALSE(plausible_with<kOverflow>(tanks, lost, 1.0));
  const Candidate gained = candidate_of<kOverflow>(tanks, 1, "max(a-edge,0)");
  EXPECT_TRUE(plausible_with<kOverflow>(tanks, gained, 1.0));
  EXPECT_EQ(reading_of<kOverflow>(tanks, lost, -1.0)->precedence, Precedence::Contextual);
  EXPECT_EQ(reading_of<kOneSidedStop>(tanks, lost, -1.0, Vector::Constant(1, 2.9))->precedence,
            Precedence::Plain);
}

TEST(Overflow, IsOfAmountsOnly) {
  EXPECT_EQ(forms_of<kOverflow>(oscillator_scope(), 1), Forms{});
}

TEST(SaturatingRate, IsOfAmountsAndOfTermsWithThem) {
  const Scope life =
      scope_of(model_of_lines({{"x", {{"x*y", -1.0}}}, {"y", {{"x*y", 1.0}}}}, {}), 2.0);
  const Forms forms = forms_of<kSaturatingRate>(life, 0);
  EXPECT_TRUE(forms.contains("x/(half+abs(x))"));
  EXPECT_TRUE(forms.contains("x*y/(half+abs(x))"));
  EXPECT_EQ(forms_of<kSaturatingRate>(oscillator_scope(), 1), Forms{});
}

TEST(RateInhibition, IsMoreInTheDenominator) {
  const Scope scope = scope_of(
      model_of_lines({{"S", {{"S/(2+S)", -0.5}}}, {"P", {{"S/(2+S)", 0.5}}}}, {}), 3.0);
  EXPECT_EQ(forms_of<kRateInhibition>(scope, 0),
            (Forms{"S/(2+S+strength*P)-S/(2+S)", "S/(2+S+strength*(S*S))-S/(2+S)"}));
  const Candidate product =
      candidate_of<kRateInhibition>(scope, 0, "S/(2+S+strength*P)-S/(2+S)");
  EXPECT_EQ(reading_of<kRateInhibition>(scope, product, -0.5)->sentence,
            "rate S/(2+S) that P inhibits");
  EXPECT_FALSE(plausible_with<kRateInhibition>(scope, product, 0.5)) << "it undoes nothing";
}

TEST(ExponentialConduction, TakesAwayFromItsOwnState) {
  const Scope scope = oscillator_scope();
  const Candidate diode = candidate_of<kExponentialConduction>(scope, 1, "exp(v/scale)-1");
  EXPECT_TRUE(plausible_with<kExponentialConduction>(scope, diode, -1e-3));
  EXPECT_FALSE(plausible_with<kExponentialConduction>(scope, diode, 1e-3));
  EXPECT_GT(diode.shapes[0].low, scope.state(1).magnitude() / 50.0) << "no overflow";
}

}  // namespace
}  // namespace lacuna
