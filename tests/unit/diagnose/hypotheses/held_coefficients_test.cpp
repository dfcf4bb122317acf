// SPDX-License-Identifier: MIT
// Records that contradict an identity or a coefficient that is held.
#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/hypotheses/broken_identity.hpp"
#include "lacuna/diagnose/journey/diagnose.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

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
