// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/corrected_inputs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

/// Records whose force was written down with half its size.
support::Asked halved() {
  Dataset data = support::hidden_record(support::nothing, 2e-3);
  data.trajectories[0].inputs *= 0.5;
  return {.records = observed(data)};
}

Dataset doubled(Dataset data) {
  for (Trajectory& record : data.trajectories) record.inputs *= 2.0;
  return data;
}

TEST(CorrectedInputs, SomethingIsMissingWhereCoefficientsAreOff) {
  const support::Asked good = support::asked(support::nothing), bad = halved();
  EXPECT_FALSE(is_anything_missing(good.problem(), good.bare()));
  EXPECT_TRUE(is_anything_missing(bad.problem(), bad.bare()));
  CompositeModel named = good.bare();
  named.named.resize(1);
  EXPECT_TRUE(is_anything_missing(good.problem(), named));
}

TEST(CorrectedInputs, TheBaselineIsThatOfTheCorrectedRecords) {
  const support::Asked asked = halved();
  const CompositeModel best = asked.bare();
  const Baseline base = corrected_baseline(asked.problem(), *best.base, doubled, 1.0);
  const support::Asked good{.records =
                                observed(support::hidden_record(support::nothing, 2e-3))};
  EXPECT_NEAR(base.fitted.deviance, good.bare().base->fitted.deviance, 0.5);
  EXPECT_NEAR(corrected_deviance(asked.problem(), *best.base, doubled, {}),
              base.fitted.deviance, 1.0);
  EXPECT_EQ(base.parameters, 1.0);
  // What was corrected before is corrected still, and first.
  const Baseline twice = corrected_baseline(
      asked.problem(), base,
      [](Dataset data) {
        data.trajectories[0].inputs.array() += 1.0;
        return data;
      },
      1.0);
  EXPECT_EQ(twice.parameters, 2.0);
  const Dataset& data = asked.records.data;
  EXPECT_EQ(twice.correct(data).trajectories[0].inputs,
            (2.0 * data.trajectories[0].inputs.array() + 1.0).matrix());
}

TEST(CorrectedInputs, ALeadIsTheDropOfTheDevianceLessThePenalties) {
  const support::Asked asked = halved();
  const CompositeModel best = asked.bare();
  const double same = best.base->fitted.deviance;
  const auto penalty = std::log(static_cast<double>(best.base->fitted.used));
  EXPECT_NEAR(lead_over(asked.problem(), best, {}, same - 100.0, 0.0), 100.0, 1e-9);
  EXPECT_NEAR(lead_over(asked.problem(), best, {}, same - 100.0, 2.0), 100.0 - 2.0 * penalty,
              1e-9);
  const FittedEffect effect{support::plain_candidate("v^3"), Vector(0), 0.1, 0.0};
  EXPECT_LT(lead_over(asked.problem(), best, {effect}, same - 100.0, 0.0),
            100.0 - 0.5 * penalty);
}

TEST(CorrectedInputs, EffectsAreTriedFromNoneToAll) {
  CompositeModel composite = support::asked(support::nothing).bare();
  composite.explanation.effects = {{support::plain_candidate("v^3"), Vector(0), 0.1, 0.0},
                                   {support::plain_candidate("q^3"), Vector(0), 0.2, 0.0}};
  const auto first = first_effects(composite);
  ASSERT_EQ(first.size(), 3u);
  EXPECT_TRUE(first[0].empty());
  ASSERT_EQ(first[1].size(), 1u);
  EXPECT_EQ(first[1][0].coefficient, 0.1);
  EXPECT_EQ(first[2].size(), 2u);
}

}  // namespace
}  // namespace lacuna
