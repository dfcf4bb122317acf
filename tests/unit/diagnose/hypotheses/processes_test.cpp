// SPDX-License-Identifier: MIT
// Processes that nobody measured, and noise that remembers.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "diagnose/hypotheses/coloured_noise.hpp"
#include "diagnose/hypotheses/input_noise.hpp"
#include "diagnose/hypotheses/shared_process.hpp"
#include "diagnose/hypotheses/unmeasured_input.hpp"
#include "effects/families.hpp"
#include "lacuna/model/files/model_file.hpp"
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

/// Effects of the same form in both equations.
std::array<FittedEffect, 2> in_both(double one, double other) {
  std::array<FittedEffect, 2> made;
  for (Index k = 0; k < 2; ++k) {
    FittedEffect& effect = made[static_cast<std::size_t>(k)];
    effect.candidate.equation = k;
    effect.coefficient = k == 0 ? one : other;
  }
  return made;
}

TEST(SharedProcess, ActsOnBothEquationsAsATermDoesThatTheyShare) {
  const OdeModel passed_on =
      parse_ode("dS/dt = -0.5*S*I - 0.02*S\ndI/dt = 0.5*S*I - 0.2*I\n", "m.ode");
  const auto [loss, gain] = in_both(-0.3, 0.1);
  EXPECT_TRUE(acts_as_shared(passed_on, loss, gain));
  const auto [first, second] = in_both(0.3, 0.1);
  EXPECT_FALSE(acts_as_shared(passed_on, first, second)) << "what one loses the other gains";
  const OdeModel alike = parse_ode("dx/dt = -x*y\ndy/dt = -2*x*y\n", "m.ode");
  EXPECT_TRUE(acts_as_shared(alike, first, second));
  EXPECT_FALSE(acts_as_shared(alike, loss, gain));
}

constexpr double kSize = 1.0, kTime = 1.0;

/// An Ornstein-Uhlenbeck process of the deviation 1 m/s^2 that remembers for 1 s, drawn every
/// 10 ms with straight lines between.
double gusts(double t, double, double) {
  constexpr double kStep = 0.01;
  static const std::vector<double> values = [] {
    Random random(5);
    const double decay = std::exp(-kStep / kTime);
    std::vector<double> drawn = {kSize * random.normal()};
    while (drawn.size() < 3200)
      drawn.push_back(decay * drawn.back() +
                      std::sqrt(1.0 - decay * decay) * kSize * random.normal());
    return drawn;
  }();
  const auto before = static_cast<std::size_t>(t / kStep);
  const double fraction = t / kStep - static_cast<double>(before);
  return (1.0 - fraction) * values[before] + fraction * values[before + 1];
}

support::Asked asked_with(const support::Hidden& hidden) {
  return support::asked(hidden, 0.005, {FamilyEffect<kUnmeasuredInput>{}});
}

TEST(UnmeasuredInput, RecoversSizeAndMemory) {
  const support::Asked asked = asked_with(gusts);
  const Proposals made = UnmeasuredInput().propose(asked.problem(), asked.bare());
  ASSERT_EQ(made.composites.size(), 1u);
  const CompositeModel& composite = made.composites[0].composite;
  ASSERT_EQ(composite.named.size(), 1u);
  const NamedEffect& named = composite.named[0];
  EXPECT_EQ(named.name, "unmeasured-input");
  EXPECT_EQ(named.equation, 1);
  EXPECT_EQ(named.coefficient, 1.0) << "its size is that of what moves it";
  const double memory = composite.explanation.effects[0].shapes[0];
  EXPECT_GT(memory, 0.4 * kTime) << "30 s hold fifteen independent values";
  EXPECT_LT(memory, 2.5 * kTime);
  const LinearisedRecord& record = composite.explanation.fit.records[0];
  double error = 0.0, size = 0.0;
  for (Index i = 0; i < record.samples(); ++i) {
    const double input = gusts(record.time[i], 0.0, 0.0);
    error += std::pow(record.path(i, 2) - input, 2);
    size += input * input;
  }
  EXPECT_LT(error, 0.05 * size) << "the input itself, sample by sample";
  EXPECT_FALSE(leaves_structure(composite, asked.options.decision));
}

TEST(UnmeasuredInput, TakesThePlaceOfAFunctionOfTimeThatLeavesStructure) {
  // A slow process looks like a line over one record, and shows most of its motion.
  const auto slow = [](double t, double q, double v) { return 0.1 * t + 0.5 * gusts(t, q, v); };
  const support::Asked asked = asked_with(slow);
  CompositeModel best = asked.bare();
  const Candidate line = support::plain_candidate("t");
  best.explanation =
      explain_on(asked.problem(), *best.base, best.base->fitted, {{line, Vector(0), 0.1, 0.0}});
  best.named = {{.equation = 1, .name = "time-trend", .probability = 0.9}};
  best.left = structure_left(asked.problem(), best.explanation.fit);
  ASSERT_TRUE(leaves_structure(best, asked.options.decision));
  ASSERT_TRUE(shows_the_motion(best, asked.problem()));
  const Proposals made = UnmeasuredInput().propose(asked.problem(), best);
  ASSERT_EQ(made.composites.size(), 1u);
  ASSERT_EQ(made.composites[0].composite.named.size(), 1u);
  EXPECT_EQ(made.composites[0].composite.named[0].name, "unmeasured-input");
}

}  // namespace
}  // namespace lacuna
