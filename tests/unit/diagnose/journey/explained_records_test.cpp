// SPDX-License-Identifier: MIT
// Clocks of records that chose nothing.
#include "diagnose/journey/explained_records.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

constexpr double kFrequency = 0.8;

support::Hidden tone_ahead(double ahead) {
  return [ahead](double t, double, double) {
    return std::sin(2.0 * std::numbers::pi * kFrequency * (t + ahead));
  };
}

Candidate tone_candidate() {
  Candidate tone = support::plain_candidate("sin(2*pi*f*t+p)");
  tone.argument = parse_expression("t");
  tone.shapes = {{"f", "1/s", 0.7, 0.9, false}, {"p", "rad", -4.0, 4.0, false}};
  tone.starts = {Vector{{kFrequency, 0.0}}};
  return tone;
}

/// The tone as it acts in a record that begins with its phase 0.
Explanation known_tone(const std::vector<FittedEffect>& more = {}) {
  const Dataset data = support::hidden_record(tone_ahead(0.0), 0.005);
  const Assimilation base = support::assimilated(data);
  std::vector<FittedEffect> effects = {{tone_candidate(), Vector{{kFrequency, 0.0}}, 1.0}};
  effects.insert(effects.end(), more.begin(), more.end());
  return explain({data, base.model, support::oscillator_fit_options(), RunContext{}}, base,
                 effects);
}

Vector offsets_of(const Explanation& found, const Dataset& other) {
  return clock_offsets(support::oscillator(), found, {as_measured(other), other}, RunContext{});
}

TEST(ClockOffsets, AreThoseOfTheTone) {
  const Explanation found = known_tone();
  for (const double ahead : {0.0, 0.3, 0.9}) {
    const Dataset other = support::hidden_record(tone_ahead(ahead), 0.005, 9, -0.4);
    const Vector offsets = offsets_of(found, other);
    ASSERT_EQ(offsets.size(), 1);
    EXPECT_NEAR(std::remainder(offsets[0] - ahead, 1.0 / kFrequency), 0.0, 0.005) << ahead;
  }
}

TEST(Gap, KeepsTheTimesOfTheRecordsInItsRuns) {
  const Dataset other = support::hidden_record(tone_ahead(0.3), 0.005, 9, -0.4);
  const Gap gap = measure_gap(support::oscillator(), known_tone(), {as_measured(other), other},
                              RunContext{});
  EXPECT_NEAR(gap.after / gap.noise_floor, 1.0, 0.1);
  ASSERT_EQ(gap.runs.size(), 1u);
  EXPECT_LT((gap.runs[0].time - other.trajectories[0].time).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace lacuna
