// SPDX-License-Identifier: MIT
// Effects that remember, effects of time, effects of the recording.
#include <gtest/gtest.h>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"
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

TEST(Lag, EveryTermOfTheEquationMayLag) {
  const auto made = candidates_of<kLag>(oscillator_scope(), 1);
  ASSERT_EQ(made.size(), 3u);
  EXPECT_EQ(made[2].form, parse_expression("lagged-F"));
  ASSERT_EQ(made[2].memory.size(), 1u);
  EXPECT_EQ(made[2].memory[0].start, parse_expression("F"));
  const std::vector<double> tau{0.5};
  EXPECT_EQ(bind_formula(made[2], made[2].memory[0].rate, tau),
            parse_expression("(F-lagged)/0.5"));
}

TEST(Lag, IsOfWhatIsThere) {
  const Scope scope = oscillator_scope();
  const Candidate slow = candidate_of<kLag>(scope, 1, "lagged-q");
  EXPECT_TRUE(plausible_with<kLag>(scope, slow, -4.0));
  EXPECT_FALSE(plausible_with<kLag>(scope, slow, 4.0));
}

TEST(ExtraState, AMassIsPulledByWhatItPulls) {
  const Scope scope = oscillator_scope();
  std::vector<Candidate> masses = candidates_of<kExtraState>(scope, 1);
  std::erase_if(masses, [](const Candidate& candidate) { return candidate.memory.size() != 2; });
  ASSERT_EQ(masses.size(), 1u);
  const Candidate& beside = masses.front();
  EXPECT_EQ(beside.memory[0].start, parse_expression("q"));
  EXPECT_EQ(beside.memory[1].start, parse_expression("v"));
  EXPECT_EQ(beside.form, parse_expression("store-q+damping/(pi*frequency)*(swing-v)"));
  EXPECT_EQ(beside.memory[1].rate,
            parse_expression("-(2*pi*frequency)^2*(store-q+damping/(pi*frequency)*(swing-v))"));
  EXPECT_NE(reading_of<kExtraState>(scope, beside, 3.0)->sentence.find("mass on a spring"),
            std::string::npos);
  EXPECT_FALSE(reading_of<kExtraState>(scope, beside, -3.0));
}

TEST(ExtraState, AMassHangsOnAPlaceOnly) {
  const Scope tanks = scope_of(
      model_of_lines({{"a", {{"u", 1.0}, {"a", -1.0}}}, {"b", {{"a", 0.5}}}}, {"u"}), 2.0);
  for (const Candidate& candidate : candidates_of<kExtraState>(tanks, 0))
    EXPECT_EQ(candidate.memory.size(), 1u) << candidate.form.to_string();
  EXPECT_TRUE(candidates_of<kExtraState>(oscillator_scope(), 0).empty()) << "an identity";
}

TEST(Delay, StartsLieAsDenseAsTheVariableForgets) {
  const Scope scope = oscillator_scope();
  const Candidate late = candidate_of<kDelay>(scope, 1, "delay(q,T)-q");
  ASSERT_GE(late.starts.size(), 4u);
  EXPECT_LE(late.starts[1][0] - late.starts[0][0], 0.5 * scope.state(0).timescale + 1e-9);
  EXPECT_LE(late.starts.back()[0], 0.25 * scope.duration);
}

TEST(Delay, OfAWholeTermOrAFactor) {
  const Scope scope =
      scope_of(model_of_lines({{"x", {{"x*y", -1.0}}}, {"y", {{"x", 1.0}}}}, {}));
  EXPECT_EQ(forms_of<kDelay>(scope, 0),
            (Forms{"delay(x,T)", "delay(y,T)", "delay(x,T)*delay(y,T)-x*y", "y*(delay(x,T)-x)",
                   "x*(delay(y,T)-y)"}));
  EXPECT_EQ(reading_of<kDelay>(scope, candidate_of<kDelay>(scope, 0, "y*(delay(x,T)-x)"), 0.1)
                ->sentence,
            "delayed action of x in x*y");
}

TEST(Backlash, OfADifferenceIsADeadZone) {
  const Scope servo = scope_of(
      model_of_lines({{"q", {{"v", 1.0}}}, {"v", {{"q", -60.0}, {"u", 60.0}}}}, {"u"}));
  const Candidate play = candidate_of<kBacklash>(servo, 1, "clip(q-u,-gap,gap)");
  EXPECT_TRUE(plausible_with<kBacklash>(servo, play, 60.0));
  EXPECT_FALSE(plausible_with<kBacklash>(servo, play, 30.0));
}

TEST(Backlash, OfOnePlaceHasAFollower) {
  const Scope scope = oscillator_scope();
  const Candidate play = candidate_of<kBacklash>(scope, 1, "clip(follower-F,-gap,gap)");
  ASSERT_EQ(play.memory.size(), 1u);
  EXPECT_TRUE(plausible_with<kBacklash>(scope, play, 1.0));
  EXPECT_FALSE(plausible_with<kBacklash>(scope, play, 0.3));
}

TEST(Hysteresis, HasALoopOfThePosition) {
  const Scope scope = oscillator_scope();
  const Candidate loop = candidate_of<kHysteresis>(scope, 1, "loop");
  EXPECT_EQ(loop.argument, parse_expression("q"));
  EXPECT_EQ(loop.memory[0].rate, parse_expression("v-(abs(v)*loop+skew*v*abs(loop))/yield"));
}

TEST(Hysteresis, HasALoopOfATwist) {
  const Scope shaft = scope_of(model_of_lines(
      {{"a", {{"d", -9.0}}}, {"d", {{"a", 1.0}, {"b", -1.0}}}, {"b", {{"d", 5.0}}}}, {}));
  const Candidate loop = candidate_of<kHysteresis>(shaft, 0, "loop");
  EXPECT_EQ(loop.argument, parse_expression("d"));
  EXPECT_EQ(loop.memory[0].rate.operands()[0], parse_expression("1*a+(-1)*b"));
}

TEST(PeriodicForcing, StartsAtTheLinesOfItsEquation) {
  Scope scope = oscillator_scope();
  scope.lines = {{1, 0.7, 0.5}, {0, 2.0, 0.0}};
  const auto made = candidates_of<kPeriodicForcing>(scope, 1);
  ASSERT_EQ(made.size(), 1u);
  EXPECT_EQ(made[0].starts[0], (Vector{{0.7, 0.5}}));
  EXPECT_NEAR(made[0].shapes[0].high, 0.8, 1e-12) << "one resolution of 10 s above";
}

TEST(ParameterDrift, IsNotToldFromWhatMovesInLessThanTwoPeriods) {
  Scope scope = oscillator_scope();
  EXPECT_TRUE(determines_time(scope));
  for (VariableRange& variable : scope.variables) variable.period = scope.duration / 1.9;
  EXPECT_FALSE(determines_time(scope));
  EXPECT_EQ(forms_of<kParameterDrift>(scope, 1), Forms{});
  EXPECT_EQ(forms_of<kTimeTrend>(scope, 1), Forms{});
}

TEST(ParameterDrift, IsOfEveryTermThatVaries) {
  EXPECT_EQ(forms_of<kParameterDrift>(oscillator_scope(), 1), (Forms{"t*q", "t*v", "t*F"}));
}

TEST(ParameterDrift, IsToldWhereALevelChangesOnce) {
  Dataset data = support::oscillator_record();
  Trajectory& record = data.trajectories.front();
  record.states.col(0) = (6.0 * record.time.array()).sin();
  record.states.bottomRows(400).array() += 4.0;
  const Scope scope = make_scope(support::oscillator(), data, Vector::Constant(2, 0.01));
  EXPECT_GT(scope.state(0).timescale, 1.0) << "the level is remembered";
  EXPECT_NEAR(scope.state(0).period, 6.2832 / 6.0, 0.1) << "what goes on about it is not";
  EXPECT_TRUE(determines_time(scope));
}

TEST(ParameterDrift, IsNotToldInOneStroke) {
  Dataset data = support::oscillator_record();
  Trajectory& record = data.trajectories.front();
  record.states.col(0) = record.time;
  record.states.col(1) = record.time.array().square();
  const Scope scope = make_scope(support::oscillator(), data, Vector::Constant(2, 0.01));
  EXPECT_FALSE(determines_time(scope)) << "half a stroke has half its memory";
}

TEST(Change, IsOfEveryTermAndOfAConstantWithinAStep) {
  const Scope scope = oscillator_scope();
  EXPECT_EQ(forms_of<kChange>(scope, 1),
            (Forms{"q*clip(100*(t-time)+0.5,0,1)", "v*clip(100*(t-time)+0.5,0,1)",
                   "F*clip(100*(t-time)+0.5,0,1)", "1*clip(100*(t-time)+0.5,0,1)"}));
  Candidate change = candidate_of<kChange>(scope, 1, "F*clip(100*(t-time)+0.5,0,1)");
  change.equation = 1;
  EXPECT_EQ(reading_of<kChange>(scope, change, 0.3)->sentence,
            "another coefficient of F from an instant on");
  const Candidate drift = candidate_of<kParameterDrift>(scope, 1, "t*F");
  EXPECT_FALSE(reading_of<kChange>(scope, drift, 0.3, Vector(0)).has_value());
}

TEST(InputLag, IsAPoleBeforeACurve) {
  const Scope scope = scope_of(
      model_of_lines({{"w", {{"w", -1.0}, {"u^2", 20.0}, {"u*w", 0.5}}}}, {"u"}));
  EXPECT_EQ(forms_of<kInputLag>(scope, 0), (Forms{"lagged^2-u^2", "w*lagged-w*u"}));
  const Candidate slow = candidate_of<kInputLag>(scope, 0, "lagged^2-u^2");
  ASSERT_EQ(slow.memory.size(), 1u);
  EXPECT_EQ(slow.memory[0].rate, parse_expression("(u-lagged)/tau"));
  EXPECT_EQ(reading_of<kInputLag>(scope, slow, 20.0)->sentence, "lag of u before u^2");
  EXPECT_FALSE(plausible_with<kInputLag>(scope, slow, -20.0)) << "it undoes nothing";
}

TEST(PeriodicFunction, StartsAtTheRippleOfItsEquation) {
  Scope scope = oscillator_scope();
  scope.ripples = {{1, 0, 0.25}};
  const auto made = candidates_of<kPeriodicFunction>(scope, 1);
  ASSERT_EQ(made.size(), 1u);
  EXPECT_EQ(made[0].form, parse_expression("sin(2*pi*q/period+phase)"));
  EXPECT_EQ(made[0].starts[0][0], 0.25);
  EXPECT_NEAR(made[0].shapes[0].low, 2.0 / 8.5, 1e-3) << "eight waves in the range of 2 m";
  EXPECT_NEAR(made[0].shapes[0].high, 2.0 / 7.5, 1e-3);
  EXPECT_TRUE(candidates_of<kPeriodicFunction>(scope, 0).empty());
}

TEST(TimeTrend, IsTimeItself) {
  EXPECT_EQ(forms_of<kTimeTrend>(oscillator_scope(), 1), Forms{"t"});
}

TEST(ChannelSkew, MovesAChannelAlongTheModel) {
  const auto made = candidates_of<kChannelSkew>(oscillator_scope(), 0);
  ASSERT_EQ(made.size(), 2u);
  for (const Candidate& candidate : made) EXPECT_EQ(candidate.place, Place::Channel);
  EXPECT_EQ(made[0].form, parse_expression("1*v"));
}

TEST(ChannelSkew, FollowsABendOfTheMotionToo) {
  const Scope scope = oscillator_scope();
  const auto made = candidates_of<kChannelSkew>(scope, 1);
  ASSERT_EQ(made.size(), 2u);
  const auto value_of = [&](const Candidate& candidate, std::vector<double> shapes) {
    const Expression form = bind_form(candidate, shapes);
    const Program program({&form, 1}, scope.model.variables());
    Program::Workspace workspace;
    // q, v, F, t, then F a step of 0.01 s ago.
    const double point[] = {0.3, 0.5, 0.2, 0.0, 0.19};
    double value = 0.0;
    program.evaluate(point, &value, workspace);
    return value;
  };
  // f = -4 q - 0.2 v + F; df/dt = -4 v - 0.2 f + dF/dt.
  const double f = -4.0 * 0.3 - 0.2 * 0.5 + 0.2;
  EXPECT_NEAR(value_of(made[0], {}), f, 1e-12);
  EXPECT_NEAR(value_of(made[1], {0.1}), f + 0.05 * (-4.0 * 0.5 - 0.2 * f + 1.0), 1e-9);
}

TEST(Hysteresis, APlayIsTheWholeOfWhatIsThere) {
  const Scope scope = oscillator_scope();
  const Candidate loop = candidate_of<kHysteresis>(scope, 1, "clip(follower-F,-gap,gap)");
  EXPECT_EQ(reading_of<kHysteresis>(scope, loop, 1.0)->precedence, Precedence::Special);
  EXPECT_EQ(reading_of<kBacklash>(scope, loop, 1.0)->precedence, Precedence::Plain);
}

TEST(Hysteresis, ALoopIsAPartOfWhatIsThere) {
  const Scope scope = oscillator_scope();
  const Candidate loop = candidate_of<kHysteresis>(scope, 1, "clip(follower-F,-gap,gap)");
  EXPECT_TRUE(plausible_with<kHysteresis>(scope, loop, 0.5));
  EXPECT_FALSE(plausible_with<kHysteresis>(scope, loop, 3.0));
  EXPECT_FALSE(plausible_with<kHysteresis>(scope, loop, -0.5));
  EXPECT_DOUBLE_EQ(loop.least, 0.0);
  EXPECT_DOUBLE_EQ(loop.most, 2.0);
}

TEST(Lag, IsNoMoreThanTheWhole) {
  const Scope scope = oscillator_scope();
  const Candidate slow = candidate_of<kLag>(scope, 1, "lagged-q");
  EXPECT_FALSE(plausible_with<kLag>(scope, slow, -400.0));
  EXPECT_DOUBLE_EQ(slow.least, -8.0);
}

TEST(Play, TheFollowerStandsStillInsideTheGap) {
  const Candidate play =
      candidate_of<kBacklash>(oscillator_scope(), 1, "clip(follower-F,-gap,gap)");
  const MemoryState& follower = play.memory[0];
  EXPECT_EQ(follower.start, parse_expression("F"));
  EXPECT_EQ(follower.rate.operands()[1],
            parse_expression("F-follower-clip(F-follower,-gap,gap)"));
  EXPECT_NEAR(follower.rate.operands()[0].value(), 800.0, 1e-6) << "eight per step of 0.01 s";
}

TEST(Delay, OfAStateItselfIsNoFasterThanTheState) {
  const Scope scope = oscillator_scope();
  const Candidate late = candidate_of<kDelay>(scope, 1, "delay(v,T)-v");
  EXPECT_TRUE(plausible_with<kDelay>(scope, late, 0.5 * late.most));
  EXPECT_FALSE(plausible_with<kDelay>(scope, late, -2.0 * late.most));
}

TEST(Delay, OfAnInputIsKnownFromATenthOfAStepOn) {
  const Scope scope = oscillator_scope();
  const Candidate late = candidate_of<kDelay>(scope, 1, "delay(F,T)-F");
  EXPECT_NEAR(late.shapes[0].low, 0.1 * scope.step, 1e-12);
  const Vector half = Vector::Constant(1, 0.5 * scope.step);
  EXPECT_TRUE(reading_of<kDelay>(scope, late, 1.0, half).has_value());
  EXPECT_FALSE(reading_of<kDelay>(scope, late, 0.5, half).has_value())
      << "a part of it could as well lag";
  EXPECT_TRUE(
      reading_of<kDelay>(scope, late, 0.5, Vector::Constant(1, 3.0 * scope.step)).has_value());
  EXPECT_NEAR(candidate_of<kDelay>(scope, 1, "delay(q,T)-q").shapes[0].low, scope.step, 1e-12);
}

TEST(UnmeasuredInput, IsDrivenAndRemembers) {
  const Scope scope = oscillator_scope();
  const auto made = candidates_of<kUnmeasuredInput>(scope, 1);
  ASSERT_EQ(made.size(), 1u);
  EXPECT_TRUE(made[0].is_driven());
  EXPECT_EQ(made[0].form, Expression::variable(made[0].memory[0].name));
  EXPECT_GT(made[0].starts.front()[0], scope.step);
  EXPECT_LE(made[0].starts.back()[0], 0.1 * scope.duration);
}

}  // namespace
}  // namespace lacuna
