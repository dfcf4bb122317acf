// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/sensor_fault.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lacuna/diagnose/journey/diagnose.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

constexpr double kHum = 3.1;  // Hz

double tone(double t, double phase = 0.4) {
  return std::sin(2.0 * std::numbers::pi * kHum * t + phase);
}

/// The speed with a hum of 0.05 m/s.
Dataset humming(std::uint64_t seed, double phase, double start) {
  Dataset data = support::hidden_record(support::nothing, 0.002, seed, start);
  Trajectory& record = data.trajectories.front();
  for (Index i = 0; i < record.samples(); ++i)
    record.states(i, 1) += 0.05 * tone(record.time[i], phase);
  return data;
}

/// A force of the hum's frequency, as a search names it.
CompositeModel with_force(const support::Asked& asked) {
  Candidate force = support::plain_candidate("sin(2*pi*frequency*t+phase)");
  force.argument = parse_expression("t");
  force.shapes = {{"frequency", "1/s", kHum - 0.03, kHum + 0.03, false},
                  {"phase", "rad", -4.0, 4.0, false}};
  force.starts = {Vector{{kHum, 1.0}}};
  CompositeModel best = asked.bare();
  best.explanation = explain_on(asked.problem(), *best.base, best.base->fitted,
                                {{force, force.starts.front(), 0.5, 0.0}});
  best.named = {{.equation = 1, .name = "periodic-forcing", .probability = 0.9}};
  return best;
}

TEST(SensorPickup, AForceStaysOne) {
  const auto force = [](double t, double, double) { return 0.6 * tone(t); };
  const support::Asked asked{.records = observed(support::hidden_record(force, 0.002))};
  EXPECT_TRUE(SensorPickup().propose(asked.problem(), with_force(asked)).composites.empty());
}

TEST(SensorPickup, OtherRecordsHaveTheirOwnPhase) {
  const Diagnosis found =
      diagnose(support::oscillator(), humming(3, 0.4, 0.5), humming(4, 2.5, -0.6),
               DiagnosisOptions{}, RunContext{});
  ASSERT_EQ(found.effects.size(), 1u);
  EXPECT_EQ(found.effects[0].name, "sensor-offset");
  EXPECT_EQ(found.verdict, Verdict::Explained);
}

}  // namespace
}  // namespace lacuna
