// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/unmeasured_input.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/effects/families.hpp"
#include "diagnose/hypotheses/input_noise.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

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
  const auto slow = [](double t, double q, double v) {
    return 0.1 * t + 0.5 * gusts(t, q, v);
  };
  const support::Asked asked = asked_with(slow);
  CompositeModel best = asked.bare();
  const Candidate line = support::plain_candidate("t");
  best.explanation = explain_on(asked.problem(), *best.base, best.base->fitted,
                                {{line, Vector(0), 0.1, 0.0}});
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
