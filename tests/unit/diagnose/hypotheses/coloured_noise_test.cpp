// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/coloured_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

/// A complete model whose sensor of q has noise of the deviation 0.1 over 0.6 s besides:
/// x_i+1 = d x_i + sqrt(1 - d^2) e with d = exp(-0.02 s / 0.6 s).
support::Asked with_memory() {
  constexpr double kDeviation = 0.1, kTime = 0.6;
  Dataset data = support::hidden_record(support::nothing, 0.01);
  Random random(11);
  const double decay = std::exp(-0.02 / kTime);
  double noise = kDeviation * random.normal();
  for (double& q : data.trajectories.front().states.col(0)) {
    q += noise;
    noise = decay * noise + std::sqrt(1.0 - decay * decay) * kDeviation * random.normal();
  }
  return {.records = observed(data)};
}

TEST(ColouredNoise, FindsDeviationAndTimeOfTheNoise) {
  const support::Asked asked = with_memory();
  CompositeModel best = asked.bare();
  best.named = {{.equation = 1, .name = "a guess"}};  // what has a name may be noise
  best.findings = {{.name = "an assumption"}};
  const Proposals made = ColouredNoiseHypothesis().propose(asked.problem(), best);
  ASSERT_EQ(made.composites.size(), 1u);
  const CompositeModel& composite = made.composites.front().composite;
  EXPECT_EQ(composite.hypothesis, "coloured-noise");
  EXPECT_EQ(composite.findings.size(), 1u) << "what its baseline assumes already";
  const auto& found = composite.base->fitted.noise.coloured[0];
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->deviation, 0.1, 0.035);
  EXPECT_GT(found->time, 0.3);
  EXPECT_LT(found->time, 1.2);
  EXPECT_NEAR(*composite.base->fitted.noise.measurement[0], 0.01, 0.003);
  EXPECT_EQ(composite.base->parameters, 4.0) << "deviation and time of two channels";
  EXPECT_FALSE(leaves_structure(composite, asked.options.decision));
}

TEST(ColouredNoise, DeclinesWithItsNumberWhereTheDynamicsExplainMore) {
  const support::Asked asked = support::asked(support::ripple);
  const Problem problem = asked.problem();
  const CompositeModel bare = asked.bare();
  EXPECT_EQ(ColouredNoiseHypothesis().propose(problem, bare).composites.size(), 1u)
      << "it is judged against the best composite model, not against none";
  CompositeModel best = bare;
  best.explanation = explain_on(problem, *best.base, best.base->fitted,
                                {{support::plain_candidate("sin(6*q)"), Vector(0), 0.0, 0.0}});
  best.named = {{.equation = 1, .name = "ripple"}};
  const Proposals made = ColouredNoiseHypothesis().propose(problem, best);
  EXPECT_TRUE(made.composites.empty());
  ASSERT_EQ(made.trail.size(), 1u);
  EXPECT_FALSE(made.trail[0].taken);
  EXPECT_GT(made.trail[0].value, made.trail[0].threshold);
  EXPECT_DOUBLE_EQ(made.trail[0].threshold, asked.options.criterion->value(evidence_of(best)));
}

}  // namespace
}  // namespace lacuna
