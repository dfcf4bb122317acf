// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/diagnose/criterion/extended_bic.hpp"
#include "lacuna/diagnose/hypotheses/composite_model.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

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

}  // namespace
}  // namespace lacuna
