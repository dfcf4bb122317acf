// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/hypotheses/composite_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/diagnose/criterion/extended_bic.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

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

TEST(CompositeModel, StructureIsSubstantialFromBothThresholdsOn) {
  const EquationStructure structure{.sigma = 3.5, .relative = 0.01};
  DecisionOptions decision;
  EXPECT_TRUE(is_substantial(structure, decision));
  decision.significance = 3.5;
  decision.effect_size = 0.01;
  EXPECT_TRUE(is_substantial(structure, decision)) << "on the thresholds";
  decision.significance = 3.6;
  EXPECT_FALSE(is_substantial(structure, decision));
  decision = {.effect_size = 0.011};
  EXPECT_FALSE(is_substantial(structure, decision));
  CompositeModel composite = made_by_hand();
  composite.left = {{.sigma = 1.0, .relative = 1.0}, structure};
  EXPECT_TRUE(leaves_structure(composite, {})) << "one equation is enough";
  EXPECT_FALSE(leaves_structure(composite, decision));
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

TEST(CompositeModel, NumbersOfTheFitComeIntoTheNames) {
  FittedEffect effect{support::stop_candidate(0.0), Vector::Constant(1, 0.25), -2.0, 0.125,
                      Vector::Constant(1, 0.5)};
  std::vector<NamedEffect> named = {{.parameters = {{"edge", "m", 0.0, {}}}}};
  update_numbers({{effect}, {.model = support::oscillator()}}, named);
  EXPECT_EQ(named[0].term, "min(q-0.25,0)");
  EXPECT_EQ(named[0].coefficient, -2.0);
  EXPECT_EQ(named[0].deviation, 0.125);
  EXPECT_EQ(named[0].parameters[0].value, 0.25);
  EXPECT_EQ(named[0].parameters[0].deviation, 0.5);
  effect.shape_deviations[0] = 0.0;
  update_numbers({{effect}, {.model = support::oscillator()}}, named);
  EXPECT_FALSE(named[0].parameters[0].deviation) << "at an end of its range";
}

}  // namespace
}  // namespace lacuna
