// SPDX-License-Identifier: MIT
// Composite models and what they are made of.
#include "lacuna/diagnose/hypotheses/composite_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/criterion/extended_bic.hpp"
#include "diagnose/hypotheses/broken_identity.hpp"
#include "diagnose/hypotheses/channel_forms.hpp"
#include "diagnose/hypotheses/named_effects.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/diagnosis_scope.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

TEST(Baseline, OutliersAreLeftOutAndNoted) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories[0].states(700, 0) += 5.0;
  const support::Asked asked{.records = observed(data)};
  const auto base = asked.baseline();
  ASSERT_FALSE(base->notes.empty());
  EXPECT_EQ(base->notes[0], "1 outlier of q was left out");
  EXPECT_EQ(base->fitted.used, 2 * 1501 - 1);
  EXPECT_NEAR(*base->fitted.noise.measurement[0], 0.01, 0.001) << "5 is no noise";
}

/// A composite model of nothing, with an effect that has one shape.
CompositeModel made_by_hand() {
  const Assimilation fit{.model = support::oscillator()};
  Baseline base{{}, fit, fit, {}, support::oscillator_scope()};
  base.fit_options.free = {{1, 0}, {1, 1}};
  base.parameters = 4.0;
  return {"made",
          std::make_shared<const Baseline>(std::move(base)),
          {{{support::stop_candidate(0.0), Vector::Zero(1), 1.0, 0.1}}, fit},
          {}};
}

TEST(CompositeModel, EvidenceCountsEveryParameterAndEveryChoice) {
  CompositeModel composite = made_by_hand();
  composite.explanation.fit.deviance = 100.0;
  composite.explanation.fit.used = 50;
  composite.named = {{.tried = 20}, {.tried = 0}};
  const Evidence evidence = evidence_of(composite);
  EXPECT_EQ(evidence.deviance, 100.0);
  EXPECT_EQ(evidence.parameters, 8.0) << "2 coefficients, 4 assumptions, a form with a shape";
  EXPECT_EQ(evidence.samples, 50.0);
  EXPECT_DOUBLE_EQ(evidence.log_choices, std::log(20.0));
  EXPECT_DOUBLE_EQ(Stage<Criterion>(ExtendedBic{})->value(evidence),
                   100.0 + 8.0 * std::log(50.0) + 2.0 * std::log(20.0));
}

TEST(CompositeModel, MostIsTheFractionOfTheVarianceThatIsAsked) {
  support::Asked asked = support::asked(support::ripple);
  CompositeModel composite = asked.bare();
  composite.explanation.fit.noise.disturbance *= std::sqrt(0.45);
  EXPECT_FALSE(closes_most(composite, asked.problem())) << "nothing is named";
  composite.named = {{.equation = 1, .name = "something"}};
  EXPECT_TRUE(closes_most(composite, asked.problem())) << "0.55 of the variance go";
  asked.options.decision.major = 0.6;
  EXPECT_FALSE(closes_most(composite, asked.problem()));
  asked.options.decision.minor = 1.1;
  EXPECT_TRUE(closes_most(composite, asked.problem())) << "the gap in windows is as it was";
}

support::Asked asked_of(const support::Hidden& hidden) {
  return support::asked(hidden, 0.01, support::own_effects());
}

/// The composite model that a form with a shape was chosen first, which does a little of dry
/// friction.
CompositeModel wrong_choice(const support::Asked& asked) {
  Candidate special = support::plain_candidate("v*abs(v)/(s+abs(v))");
  special.shapes = {{"s", "m/s", 0.1, 10.0, false}};
  special.starts = {Vector::Constant(1, 1.0)};
  CompositeModel composite = asked.bare();
  composite.explanation = explain_on(asked.problem(), *composite.base, composite.base->fitted,
                                     {{special, special.starts.front(), -0.1, 0.0}});
  composite.named = {{.equation = 1, .name = "special"}};
  composite.left = test_disturbances(composite.explanation.fit, asked.context);
  return composite;
}

TEST(OtherChoices, TakeThePlaceOfAFirstChoiceThatLeavesSomething) {
  const support::Asked asked = asked_of(support::dry_friction);
  CompositeModel first = wrong_choice(asked);
  first.notes = {"a note"};
  ASSERT_TRUE(has_residual_structure(first.left, asked.options.decision));
  const Proposals made = OtherChoices().propose(asked.problem(), first);
  ASSERT_EQ(made.composites.size(), 1u);
  const Proposal& proposal = made.composites[0];
  ASSERT_EQ(proposal.composite.named.size(), 1u);
  EXPECT_EQ(proposal.composite.named[0].name, "dry");
  EXPECT_EQ(proposal.composite.notes, first.notes);
  EXPECT_EQ(std::get<ByCriterion>(proposal.judged).lead, -asked.options.decision.undecided)
      << "it has fewer parameters";
  EXPECT_FALSE(made.trail.empty());
}

TEST(OtherChoices, DoNotTakeThePlaceOfWhatLeavesLessInWindows) {
  support::Asked asked = asked_of(support::dry_friction);
  CompositeModel first = wrong_choice(asked);
  std::vector<FittedEffect> both = first.explanation.effects;
  both.push_back({support::plain_candidate("sign(v)"), Vector(0), -0.3, 0.0});
  first.explanation =
      explain_on(asked.problem(), *first.base, first.base->fitted, std::move(both));
  first.explanation.fit.deviance += 2e4;  // as if it were worse from sample to sample
  EXPECT_EQ(OtherChoices().propose(asked.problem(), first).composites.size(), 1u)
      << "dry friction, which leaves as little";
  asked.options.effects = {support::FormEffect<support::kCubic>("q^3")};
  EXPECT_TRUE(OtherChoices().propose(asked.problem(), first).composites.empty())
      << "a cubic spring, which leaves more";
}

TEST(OtherChoices, TakeThePlaceOfAFirstChoiceWhoseTimeEndedWhereItsRangeDoes) {
  const support::Asked asked = asked_of(support::dry_friction);
  CompositeModel first = wrong_choice(asked);
  first.left.clear();  // as if it left nothing
  FittedEffect& chosen = first.explanation.effects[0];
  chosen.candidate.form = parse_expression("delay(q,s)-q");
  chosen.shapes[0] = 1.0;
  EXPECT_TRUE(OtherChoices().propose(asked.problem(), first).composites.empty());
  chosen.shapes[0] = chosen.candidate.shapes[0].low;
  const Proposals made = OtherChoices().propose(asked.problem(), first);
  ASSERT_EQ(made.composites.size(), 1u);
  ASSERT_EQ(made.composites[0].composite.named.size(), 1u);
  EXPECT_EQ(made.composites[0].composite.named[0].name, "dry");
}

FittedEffect fitted(const Candidate& candidate, double coefficient, double shape = 0.0) {
  Vector shapes(static_cast<Index>(candidate.shapes.size()));
  shapes.setConstant(shape);
  return {candidate, shapes, coefficient, 0.0};
}

/// The form of a channel.
Candidate form_of(const std::string& text, const Scope& scope, Index state = 1) {
  for (const Candidate& form : channel_forms(scope, state))
    if (form.form == parse_expression(text)) return form;
  ADD_FAILURE() << "there is no " << text;
  return {};
}

void expect_name(const Candidate& form, double coefficient, const std::string& name,
                 const std::string& words, double shape = 0.0) {
  const ChannelName said =
      channel_name(fitted(form, coefficient, shape), support::oscillator_scope().model);
  EXPECT_EQ(said.name, name);
  EXPECT_NE(said.sentence.find(words), std::string::npos) << said.sentence;
}

TEST(ChannelForms, HaveNamesAndSentences) {
  const Scope scope = support::oscillator_scope();
  expect_name(form_of("v", scope), 0.03, "sensor-gain", "3 % too much");
  expect_name(form_of("v", scope), -0.03, "sensor-gain", "3 % too little");
  expect_name(form_of("1", scope), 0.2, "sensor-offset", "0.2 m/s too much");
  expect_name(form_of("t", scope), 0.2, "sensor-drift", "0.2 m/s per s");
  expect_name(form_of("behind-v", scope), 1.0, "sensor-lag", "0.07 s", 0.07);
  expect_name(form_of("v^2", scope), -0.1, "sensor-gain",
              "not linear: it reads 0.1*v^2 too little");
  expect_name(form_of("end*tanh(v/end)-v", scope), 1.0, "sensor-gain", "3*tanh(v/3)", 3.0);
  expect_name(form_of("q", scope), 0.05, "sensor-offset", "picks up 0.05*q too much");
  expect_name(form_of("F", scope), 0.05, "sensor-offset", "picks up 0.05*F too much");
}

/// 1/(1 + L s + b (L s)^2) against 1 + c (1/(1 + tau s)^n - 1), both to the second power of s.
TEST(ChannelForms, AreLateByALagOrADelay) {
  const Scope scope = support::oscillator_scope();
  const std::vector<Candidate> late = late_channel_forms(scope, 1);
  ASSERT_EQ(late.size(), 2u);
  for (const Candidate& form : late) EXPECT_TRUE(is_whole(form));
  const auto said = [&](std::size_t filters, double coefficient) {
    return channel_name({late[filters - 1], Vector::Constant(1, 0.07), coefficient, 0.0},
                        scope.model);
  };
  EXPECT_EQ(said(1, 1.0).name, "sensor-lag");
  EXPECT_EQ(said(2, 1.0).name, "sensor-lag");
  EXPECT_NE(said(2, 1.0).sentence.find("0.14 s"), std::string::npos);
  EXPECT_EQ(said(2, 9.0 / 8.0).name, "sensor-lag") << "means";
  EXPECT_EQ(said(1, 1.5).name, "sensor-lag") << "means";
  EXPECT_EQ(said(1, 2.0).name, "channel-skew") << "a delay of 0.14 s";
  EXPECT_NE(said(1, 2.0).sentence.find("0.14 s"), std::string::npos);
  EXPECT_EQ(said(2, 1.5).name, "channel-skew");
}

TEST(ChannelForms, AToneOfTheResidualsMayBeAHum) {
  Scope scope = support::oscillator_scope();
  const std::size_t without = channel_forms(scope, 1).size();
  scope.lines = {{0, 5.0, 0.3}, {1, 0.1, 0.0}};  // the second is longer than half the record
  EXPECT_EQ(channel_forms(scope, 1).size(), without + 1);
  const Candidate hum = form_of("sin(2*pi*frequency*t+phase)", scope);
  EXPECT_EQ(hum.equation, 1) << "wherever the line was seen";
  EXPECT_FALSE(is_whole(hum));
  expect_name(hum, 0.02, "sensor-offset", "a hum of 0.02 m/s, 5 per s", 5.0);
}

// Records that contradict an identity or a coefficient that is held.
/// A complete model whose sensor of v has an offset and a gain.
support::Asked with_sensor(double offset, double gain) {
  Dataset data = support::hidden_record(support::nothing, 0.005);
  auto v = data.trajectories.front().states.col(1).array();
  v = offset + gain * v;
  return {.records = observed(data)};
}

TEST(BrokenIdentity, AGainIsTheIdentitysCoefficient) {
  const support::Asked asked = with_sensor(0.0, 1.25);
  CompositeModel best = asked.bare();
  best.findings = {{.name = "an assumption"}};
  const Proposals made = BrokenIdentity().propose(asked.problem(), best);
  ASSERT_EQ(made.composites.size(), 1u);
  EXPECT_EQ(made.composites[0].composite.findings.size(), 1u)
      << "what the baseline assumes already";
  EXPECT_TRUE(made.composites[0].search_first);
  const Baseline& base = *made.composites[0].composite.base;
  EXPECT_EQ(base.fit_options.free.size(), 4u) << "q, v, F and the identity's v";
  EXPECT_EQ(base.fit_options.free.back(), (CoefficientPlace{0, 0}));
  EXPECT_EQ(base.parameters, 1.0) << "the variance of its disturbance";
  EXPECT_NEAR(base.fitted.model.coefficient(0, "v"), 1.0 / 1.25, 0.01);
  EXPECT_NEAR(base.fitted.model.coefficient(1, "q"), -4.0 * 1.25, 0.05);
  ASSERT_FALSE(base.notes.empty());
  EXPECT_NE(base.notes.back().find("contradict an identity"), std::string::npos);
}

TEST(BrokenIdentity, OfAStateThatWasNotMeasuredAnIdentityIsTheDefinition) {
  Dataset data = with_sensor(0.0, 1.25).records.data;
  data.reconstructed = {false, true};
  const support::Asked asked{.records = observed(data)};
  CompositeModel best = asked.bare();
  ASSERT_FALSE(best.base->given.noise.measurement[1]);
  const Proposals made = BrokenIdentity().propose(asked.problem(), best);
  EXPECT_TRUE(made.composites.empty() && made.trail.empty());
}

/// The oscillator whose force acts as it was measured, whatever the records show.
OdeModel with_known_force() {
  OdeModel model = support::oscillator();
  std::vector<Equation> equations = model.equations();
  for (WeightedTerm& summand : equations[1])
    if (summand.term.name() == "F") summand.fixed = true;
  return model.with_equations(std::move(equations)).with_holds({Hold::Smooth});
}

/// A record whose load cell shows so much more than the force.
Dataset shown_force(const support::Hidden& hidden, double gain, std::uint64_t seed = 3,
                    double start = 0.5) {
  Dataset data = support::hidden_record(hidden, 0.005, seed, start);
  for (Trajectory& record : data.trajectories) record.inputs *= gain;
  return data;
}

support::Asked asked_of(const support::Hidden& hidden, double gain) {
  return {.records = observed(shown_force(hidden, gain)), .nominal = with_known_force()};
}

TEST(HeldCoefficients, WhatEffectsExplainContradictsNone) {
  const auto drag = [](double, double, double v) { return -1.2 * v * std::abs(v); };
  const support::Asked asked = asked_of(drag, 1.0);
  CompositeModel composite = asked.bare();
  EXPECT_EQ(HeldCoefficients().propose(asked.problem(), composite).composites.size(), 1u)
      << "without the drag a smaller force does a part of it";
  const FittedEffect effect{support::plain_candidate("v*abs(v)"), Vector(0), -1.2, 0.0};
  composite.explanation =
      explain_on(asked.problem(), *composite.base, composite.base->fitted, {effect});
  composite.named = {{.equation = 1, .name = "drag"}};
  EXPECT_TRUE(HeldCoefficients().propose(asked.problem(), composite).composites.empty());
  const support::Asked shown = asked_of(drag, 1.25);
  composite.base = shown.baseline();
  composite.explanation = explain_on(shown.problem(), *composite.base, composite.base->fitted,
                                     composite.explanation.effects);
  EXPECT_EQ(HeldCoefficients().propose(shown.problem(), composite).composites.size(), 1u)
      << "a load cell that shows a quarter too much is off beside the drag as well";
}

TEST(HeldCoefficients, AnEffectOfTheSameVariableExplainsNothingOfItsCoefficient) {
  const support::Asked asked = asked_of(support::nothing, 1.1);
  CompositeModel composite = asked.bare();
  const FittedEffect bend{support::plain_candidate("F^3"), Vector(0), 0.0, 0.0};
  composite.explanation =
      explain_on(asked.problem(), *composite.base, composite.base->fitted, {bend});
  composite.named = {{.equation = 1, .name = "bend"}};
  EXPECT_EQ(HeldCoefficients().propose(asked.problem(), composite).composites.size(), 1u);
}

TEST(HeldCoefficients, NoBendIsNamedForAGain) {
  const Diagnosis found =
      diagnose(with_known_force(), shown_force(support::nothing, 1.25),
               shown_force(support::nothing, 1.25, 4, -0.6), DiagnosisOptions{}, RunContext{});
  EXPECT_TRUE(found.effects.empty());
  EXPECT_EQ(found.verdict, Verdict::CoefficientsOnly);
  EXPECT_NEAR(found.augmented.coefficient(1, "F"), 0.8, 0.01);
}

}  // namespace
}  // namespace lacuna
