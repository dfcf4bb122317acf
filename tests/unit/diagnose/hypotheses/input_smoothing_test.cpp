// SPDX-License-Identifier: MIT
// Inputs that were measured with noise, which does not act.
#include <gtest/gtest.h>

#include <cmath>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "core/base/random.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"
#include "lacuna/diagnose/journey/diagnose.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

Dataset with_noisy_input(Dataset data, double noise, std::uint64_t seed = 11) {
  Random random(seed);
  for (Trajectory& record : data.trajectories)
    for (double& u : record.inputs.reshaped()) u += noise * random.normal();
  return data;
}

double off(const Dataset& data, const Dataset& truth) {
  const Matrix rest = data.trajectories[0].inputs - truth.trajectories[0].inputs;
  return std::sqrt(rest.array().square().mean());
}

/// The force as levels that jump.
Dataset levels(std::uint64_t seed, double noise) {
  Random random(seed);
  Dataset data = support::hidden_record(support::nothing, 0.0);
  Trajectory& record = data.trajectories[0];
  double level = 1.0, q = 0.5, v = 0.0;
  for (Index i = 0; i < record.samples(); ++i) {
    if (i % 60 == 0) level = random.uniform(-2.0, 2.0);
    record.states.row(i) << q + 1e-4 * random.normal(), v + 1e-4 * random.normal();
    record.inputs(i, 0) = level;
    constexpr int kParts = 200;  // of a step: semi-implicit Euler
    for (int part = 0; part < kParts; ++part) {
      v += 0.02 / kParts * (-4.0 * q - 0.2 * v + level);
      q += 0.02 / kParts * v;
    }
  }
  return with_noisy_input(std::move(data), noise, seed + 1);
}

TEST(InputSmoothing, KeepsTheJumpsOfLevels) {
  const support::Asked asked{.records = observed(levels(3, 0.05))};
  const auto composites = InputSmoothing{}.propose(asked.problem(), asked.bare()).composites;
  ASSERT_EQ(composites.size(), 1u);
  const Dataset smooth = composites[0].composite.base->correct(levels(9, 0.05));
  EXPECT_LT(off(smooth, levels(9, 0.0)), 0.5 * 0.05);
}

TEST(InputSmoothing, NoiseThatActsStays) {
  // A record in which what was measured is what acted, noise and all.
  Dataset data = levels(3, 0.0);
  Trajectory& record = data.trajectories[0];
  Random random(4);
  double q = 0.5, v = 0.0;
  for (Index i = 0; i < record.samples(); ++i) {
    record.inputs(i, 0) += 0.3 * random.normal();
    record.states.row(i) << q + 1e-4 * random.normal(), v + 1e-4 * random.normal();
    for (int part = 0; part < 200; ++part) {
      v += 1e-4 * (-5.0 * q - 0.2 * v + record.inputs(i, 0));
      q += 1e-4 * v;
    }
  }
  const support::Asked asked{.records = observed(data)};
  EXPECT_TRUE(InputSmoothing{}.propose(asked.problem(), asked.bare()).composites.empty());
}

TEST(InputSmoothing, NoPlayIsNamedForNoise) {
  Configuration configuration;
  configuration.set("effects=[\"backlash\",\"delay\",\"lag\",\"dead-zone\"]");
  const Diagnosis found =
      diagnose(support::oscillator(), levels(3, 0.05), levels(9, 0.05),
               diagnosis_options(configuration, default_registry()), RunContext{});
  EXPECT_TRUE(found.effects.empty());
}

}  // namespace
}  // namespace lacuna
