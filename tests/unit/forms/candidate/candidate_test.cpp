// SPDX-License-Identifier: MIT
// Candidates, the scope and the forms that effects propose.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "effects/families.hpp"
#include "forms/candidate/nesting.hpp"
#include "forms/candidate/tone.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/effects/effects.hpp"
#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/diagnosis_scope.hpp"
#include "support/effect_forms.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using support::candidate_of;

Candidate delayed() {
  Candidate candidate;
  candidate.form = parse_expression("a_1*delay(x,a)-b*x");
  candidate.shapes = {{"a", "s", 0.0, 2.0, false}, {"b", "", -2.0, 2.0, false}};
  return candidate;
}

/// A clipped q, with names and range of its own.
Candidate clipped(const std::string& edge, const std::string& family, double low, double high) {
  Candidate candidate;
  candidate.form = parse_expression("clip(q,-" + edge + "," + edge + ")");
  candidate.argument = Expression::variable("q");
  candidate.shapes = {{edge, "m", low, high, false}};
  candidate.starts = {Vector::Constant(1, 0.5 * (low + high))};
  candidate.families = {family};
  return candidate;
}

Candidate lag(const std::string& name) {
  Candidate candidate;
  candidate.form = parse_expression(name + "-u");
  candidate.argument = Expression::variable("u");
  candidate.memory = {
      {name, parse_expression("(u-" + name + ")/2"), Expression::variable("u")}};
  return candidate;
}

TEST(Candidate, DependsOnWhatItsFormAndItsMemoryAreFunctionsOf) {
  EXPECT_TRUE(delayed().depends_on("x"));
  EXPECT_FALSE(delayed().depends_on("u"));
  Candidate remembered = lag("follower");
  remembered.form = parse_expression("follower");
  EXPECT_TRUE(remembered.depends_on("u")) << "through its memory";
  EXPECT_FALSE(remembered.depends_on("x"));
}

TEST(Candidate, MemoryGetsAnotherNameWhereItsOwnIsTaken) {
  const Candidate apart = without_clash(lag("lagged"), {"lagged", "lagged2"});
  EXPECT_EQ(apart.memory[0].name, "lagged3");
  EXPECT_EQ(apart.form, parse_expression("lagged3-u"));
  EXPECT_EQ(apart.memory[0].rate, parse_expression("(u-lagged3)/2"));
}

TEST(Candidate, NamesOfShapesAndMemoryDoNotTellFormsApart) {
  EXPECT_TRUE(are_one_form(clipped("edge", "a", 0.1, 0.5), clipped("gap", "b", 0.2, 0.9)));
  EXPECT_TRUE(are_one_form(lag("lagged"), lag("slow")));
  Candidate elsewhere = clipped("edge", "a", 0.1, 0.5);
  elsewhere.equation = 1;
  EXPECT_FALSE(are_one_form(elsewhere, clipped("edge", "a", 0.1, 0.5)));
  Candidate other = lag("lagged");
  other.memory[0].rate = parse_expression("(u-lagged)/3");
  EXPECT_FALSE(are_one_form(lag("lagged"), other));
}

TEST(Candidate, OneFormIsSearchedOnce) {
  const std::vector<Candidate> all = merged(
      {clipped("edge", "dead-zone", 0.1, 0.5), lag("l"), clipped("gap", "backlash", 0.2, 0.9)});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].shapes[0].low, 0.1);
  EXPECT_EQ(all[0].shapes[0].high, 0.9);
  EXPECT_EQ(all[0].starts.size(), 2u);
  EXPECT_EQ(all[0].families, (std::vector<std::string>{"dead-zone", "backlash"}));
}

TEST(Candidate, TonesStayApart) {
  Candidate tone = clipped("frequency", "hum", 1.0, 2.0);
  tone.repeats = true;
  EXPECT_EQ(merged({tone, tone}).size(), 2u);
}

TEST(Tone, BeginsAtTheLineWithinTheResolutionOfTheRecord) {
  const Candidate tone = tone_candidate({1, 3.0, 0.5}, support::oscillator_scope());
  EXPECT_EQ(tone.form, parse_expression("sin(2*pi*frequency*t+phase)"));
  EXPECT_EQ(tone.equation, 1);
  EXPECT_EQ(tone.place, Place::Rate);
  ASSERT_EQ(tone.shapes.size(), 2u);
  EXPECT_NEAR(tone.shapes[0].low, 2.9, 1e-12);
  EXPECT_NEAR(tone.shapes[0].high, 3.1, 1e-12);
  EXPECT_EQ(tone.shapes[0].unit, "1/s");
  EXPECT_NEAR(tone.shapes[1].high - tone.shapes[1].low, 2.0 * std::numbers::pi, 1e-12);
  ASSERT_EQ(tone.starts.size(), 1u);
  EXPECT_EQ(tone.starts[0], (Vector{{3.0, 0.5}}));
}

TEST(Tone, HasTwoPeriodsAtLeast) {
  const Candidate tone = tone_candidate({1, 0.2, 0.5}, support::oscillator_scope());
  EXPECT_NEAR(tone.shapes[0].low, 0.2, 1e-12);
  EXPECT_NEAR(tone.shapes[0].high, 0.3, 1e-12);
}

bool has(const Candidate& general, const Candidate& special) {
  return nests(general, special, special.starts.front(), support::oscillator_scope());
}

TEST(Nesting, SharpFrictionIsASpecialCaseOfSmoothAndOfRisingOne) {
  const Scope scope = support::oscillator_scope();
  const Candidate sharp = candidate_of<kCoulombFriction>(scope, 1, "sign(v)");
  const Candidate smooth = candidate_of<kCoulombFriction>(scope, 1, "tanh(v/width)");
  const Candidate rising =
      candidate_of<kStribeckFriction>(scope, 1, "(1+rise*exp(-(v/speed)^2))*sign(v)");
  EXPECT_TRUE(has(smooth, sharp));
  EXPECT_TRUE(has(rising, sharp));
  EXPECT_FALSE(has(sharp, smooth)) << "the other way round";
  EXPECT_FALSE(has(rising, candidate_of<kQuadraticDrag>(scope, 1, "v*abs(v)")));
}

TEST(Nesting, ACubeIsASoftLimitFarAway) {
  const Scope scope = support::oscillator_scope();
  const Candidate cube = candidate_of<kCubicTerm>(scope, 1, "q^3");
  EXPECT_TRUE(has(candidate_of<kSaturation>(scope, 1, "q-limit*tanh(q/limit)"), cube));
  EXPECT_FALSE(has(candidate_of<kSaturation>(scope, 1, "q-clip(q,-limit,limit)"), cube));
}

TEST(Nesting, FormsOfOtherVariablesDoNotNest) {
  const Scope scope = support::oscillator_scope();
  EXPECT_FALSE(has(candidate_of<kSaturation>(scope, 1, "q-limit*tanh(q/limit)"),
                   candidate_of<kCubicTerm>(scope, 1, "v^3")));
}

TEST(Nesting, SamplesDoNotTellWhatRemembers) {
  const Scope scope = support::oscillator_scope();
  EXPECT_FALSE(
      has(candidate_of<kLag>(scope, 1, "lagged-q"), candidate_of<kCubicTerm>(scope, 1, "q^3")));
}

inline constexpr StageInfo kMade{"made", "Candidates that the test gives", ""};

/// An effect whose one candidate the test chooses.
class Made final : public Configured<Effect, EffectOptions<kMade>> {
 public:
  explicit Made(Candidate candidate) : candidate_(std::move(candidate)) {}

 private:
  std::string_view do_typical_cause() const override { return "a test"; }
  std::vector<Candidate> do_candidates(const Scope&, Index) const override {
    return {candidate_};
  }
  Candidate candidate_;
};

Candidate edge(double start) {
  Candidate candidate;
  candidate.form = parse_expression("max(q-edge,0)");
  candidate.shapes = {{"edge", "m", -1.0, 1.0, false}};
  candidate.starts = {Vector::Constant(1, start)};
  return candidate;
}

TEST(Effect, FillsInNameEquationAndTheEmptyStart) {
  Candidate plain;
  plain.form = parse_expression("q*abs(v)");
  const auto made = Made(plain).candidates(support::oscillator_scope(), 1);
  ASSERT_EQ(made.size(), 1u);
  EXPECT_EQ(made[0].families, std::vector<std::string>{"made"});
  EXPECT_EQ(made[0].equation, 1);
  ASSERT_EQ(made[0].starts.size(), 1u);
  EXPECT_EQ(made[0].starts[0].size(), 0);
}

TEST(Effect, RefusesStartsOutsideTheRange) {
  const Scope scope = support::oscillator_scope();
  EXPECT_EQ(Made(edge(0.5)).candidates(scope, 1).size(), 1u);
  EXPECT_THROW(Made(edge(1.5)).candidates(scope, 1), ModelError);
}

TEST(Effect, WithoutARangeThereIsNothingToFind) {
  const Scope scope = support::oscillator_scope();
  Candidate candidate = edge(0.5);
  candidate.shapes[0].low = 1.1;  // above the largest value
  EXPECT_TRUE(Made(candidate).candidates(scope, 1).empty());
  candidate.shapes[0] = {"edge", "m", 0.0, 1.0, true};
  EXPECT_TRUE(Made(candidate).candidates(scope, 1).empty()) << "no logarithm of 0";
  candidate.shapes[0] = {"edge", "m", -NAN, 1.0, false};
  EXPECT_TRUE(Made(candidate).candidates(scope, 1).empty());
}

TEST(Effect, RefusesUnknownNames) {
  Candidate wrong = edge(0.5);
  wrong.form = parse_expression("max(p-edge,0)");
  EXPECT_THROW(Made(wrong).candidates(support::oscillator_scope(), 1), ModelError);
}

TEST(Effect, NamesAreKeptApartFromTheModels) {
  const Scope scope = support::oscillator_scope();
  const Expression q = Expression::variable("q");
  Candidate clash;
  clash.form = formula(scope, "tanh(x/q)+v", {{"x", q}});
  clash.shapes = {{"q", "m", 0.0, 1.0, false}};
  clash.starts = {Vector::Constant(1, 0.5)};
  clash.memory = {{"v", formula(scope, "(x-v)/q", {{"x", q}}), Expression::variable("v")}};
  const Candidate made = Made(clash).candidates(scope, 1).at(0);
  EXPECT_EQ(made.form, parse_expression("tanh(q/q_)+v_"));
  EXPECT_EQ(made.shapes[0].name, "q_");
  EXPECT_EQ(made.memory[0].name, "v_");
  EXPECT_EQ(made.memory[0].rate, parse_expression("(q-v_)/q_"));
}

TEST(Effect, WhatItProposesIsItUnlessItSaysOtherwise) {
  const Scope scope = support::oscillator_scope();
  const NamingOptions options;
  const Made made(edge(0.5));
  Candidate candidate = made.candidates(scope, 1).at(0);
  const auto reading = [&](const Vector& shapes) {
    return made.reading({candidate, shapes, 1.0, 0.1, scope.model, scope, options});
  };
  ASSERT_TRUE(reading(Vector::Zero(1)).has_value());
  EXPECT_EQ(reading(Vector::Zero(1))->sentence, "Candidates that the test gives");
  EXPECT_THROW(reading(Vector::Zero(2)), ArgumentError);
  candidate.families = {"another"};
  EXPECT_FALSE(reading(Vector::Zero(1)).has_value());
}

TEST(Scope, DescribesEveryVariable) {
  const Scope scope = support::oscillator_scope();
  ASSERT_EQ(scope.variables.size(), 3u);
  EXPECT_EQ(scope.variables[2].name, "F");
  EXPECT_TRUE(scope.variables[2].is_input);
  EXPECT_NEAR(scope.state(1).high, 2.0, 1e-3);
  EXPECT_NEAR(scope.state(1).low, -2.0, 1e-3);
  EXPECT_NEAR(scope.state(0).quantile(0.5), 0.0, 0.1);
  EXPECT_EQ(scope.state(0).quantile(1.0), scope.state(0).high);
  EXPECT_DOUBLE_EQ(scope.state(0).noise, 0.01);
}

TEST(Scope, KnowsTheTimes) {
  const Scope scope = support::oscillator_scope();
  EXPECT_NEAR(scope.step, 0.01, 1e-12);
  EXPECT_NEAR(scope.duration, 10.0, 1e-12);
}

TEST(Scope, KnowsHowLongVariablesRemember) {
  // cos(2 t) falls to one half at 2 t = pi/3.
  const Scope scope = support::oscillator_scope();
  EXPECT_NEAR(scope.state(0).timescale, 0.52, 0.05);
}

TEST(Scope, TellsAmountsFromSignedVariables) {
  Dataset data = support::oscillator_record();
  data.trajectories[0].states.col(0).array() += 1.5;
  const Scope scope = make_scope(support::oscillator(), data, Vector::Constant(2, 0.01));
  EXPECT_TRUE(scope.state(0).is_amount());
  EXPECT_FALSE(scope.state(0).changes_sign());
  EXPECT_FALSE(scope.state(1).is_amount());
  EXPECT_TRUE(scope.state(1).changes_sign());
}

TEST(Scope, AnAmountMayBeUsedUpForLong) {
  Dataset data = support::oscillator_record();
  auto q = data.trajectories[0].states.col(0).array();
  for (Index i = 0; i < q.size(); ++i)
    q[i] = std::max(q[i], 0.0) + (i % 2 == 0 ? 0.02 : -0.02);  // below 0 a quarter of the time
  const auto amount = [&](double noise) {
    return make_scope(support::oscillator(), data, Vector::Constant(2, noise))
        .state(0)
        .is_amount();
  };
  EXPECT_TRUE(amount(0.01));
  EXPECT_FALSE(amount(0.003)) << "noise does not take it as far below 0";
}

TEST(Scope, FormulasHaveARange) {
  const VariableRange range =
      support::oscillator_scope().range_of(parse_expression("4*q^2+v^2"));
  EXPECT_NEAR(range.low, 4.0, 1e-9);
  EXPECT_NEAR(range.high, 4.0, 1e-9);
  EXPECT_THROW(support::oscillator_scope().range_of(parse_expression("delay(q,1)")),
               ModelError);
}

TEST(Scope, NamesOfTheModelAreNotFree) {
  const Scope scope = support::oscillator_scope();
  EXPECT_EQ(scope.free_name("edge"), "edge");
  EXPECT_EQ(scope.free_name("q"), "q_");
}

TEST(Scope, KnowsIdentities) {
  const Scope scope = support::oscillator_scope();
  EXPECT_TRUE(scope.is_identity(0));
  EXPECT_FALSE(scope.is_identity(1));
  EXPECT_EQ(scope.integral_of(1), std::optional<Index>(0));
  EXPECT_EQ(scope.integral_of(0), std::nullopt);
}

TEST(Scope, RecordsMustFitTheModel) {
  Dataset other = support::oscillator_record();
  other.inputs[0].name = "u";
  EXPECT_THROW(make_scope(support::oscillator(), other, Vector::Zero(2)), ArgumentError);
}

TEST(Scope, WhatTheModelHasDelayedHasTheRangeOfItsPast) {
  const OdeModel late =
      parse_ode("input F\ndq/dt = v\ndv/dt = -4*q + delay(F, 2) - delay(q, 0.5)\n", "late");
  const Scope scope = make_scope(late, support::oscillator_record(), Vector::Constant(2, 0.01));
  const VariableRange range = scope.range_of(parse_expression("delay(q,0.5)^2"));
  EXPECT_NEAR(range.low, 0.0, 1e-3);
  EXPECT_NEAR(range.high, 1.0, 1e-3);
  const double late_by = scope.range_of(parse_expression("q-delay(q,0.5)")).high;
  EXPECT_NEAR(late_by, 2.0 * std::sin(0.5), 1e-3) << "sin(2 t) - sin(2 t - 1)";
  testing::expect_error<ModelError>(
      [&] { (void)scope.range_of(parse_expression("delay(q,0.6)")); }, "'delay(q,0.6)'",
      "no such delay", "of delays of the model");
}

}  // namespace
}  // namespace lacuna
