// SPDX-License-Identifier: MIT
// A part that hangs on a spring and that nobody measured.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "core/base/random.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/diagnose/journey/diagnose.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

constexpr double kSpring = 30.0, kDamper = 0.4, kMass = 0.3;

/// q, v of support::oscillator() with a mass p, w on a spring and a damper, levels for the force.
Dataset with_a_mass(std::uint64_t seed) {
  Dataset data = support::hidden_record(support::nothing, 0.0);
  Trajectory& record = data.trajectories[0];
  Random random(seed);
  std::array<double, 4> at{0.0, 0.0, 0.0, 0.0};  // q, v, p, w
  double force = 1.0;
  for (Index i = 0; i < record.samples(); ++i) {
    if (i % 40 == 0) force = random.uniform(-2.0, 2.0);
    record.states.row(i) << at[0] + 2e-3 * random.normal(), at[1] + 4e-3 * random.normal();
    record.inputs(i, 0) = force;
    constexpr int kParts = 400;  // of a step: semi-implicit Euler
    for (int part = 0; part < kParts; ++part) {
      const double h = 0.02 / kParts;
      const double pull = kSpring * (at[2] - at[0]) + kDamper * (at[3] - at[1]);
      at[1] += h * (-4.0 * at[0] - 0.2 * at[1] + force + pull);
      at[3] -= h * pull / kMass;
      at[0] += h * at[1];
      at[2] += h * at[3];
    }
  }
  data.states.resize(1);  // v is not measured
  record.states = Matrix(record.states.leftCols(1));
  return model_view(support::oscillator(), data, FiniteDifferences{});
}

TEST(FlexibleMass, IsNamedWithItsFrequency) {
  Configuration configuration;
  configuration.set(
      "effects=[\"extra-state\",\"delay\",\"lag\",\"cubic-stiffness\",\"linear-term\"]");
  const Diagnosis found =
      diagnose(support::oscillator(), with_a_mass(3), with_a_mass(8),
               diagnosis_options(configuration, default_registry()), RunContext{});
  EXPECT_EQ(found.verdict, Verdict::Explained);
  ASSERT_EQ(found.effects.size(), 1u);
  const NamedEffect& effect = found.effects[0];
  EXPECT_EQ(effect.name, "extra-state");
  EXPECT_NEAR(effect.coefficient, kSpring, 0.1 * kSpring);
  const double frequency = std::sqrt(kSpring / kMass) / (2.0 * std::numbers::pi);
  const double damping = 0.5 * kDamper / std::sqrt(kSpring * kMass);
  ASSERT_EQ(effect.parameters.size(), 2u);
  EXPECT_NEAR(effect.parameters[0].value, frequency, 0.02 * frequency);
  EXPECT_NEAR(effect.parameters[1].value, damping, 0.5 * damping);  // small beside a spring
}

}  // namespace
}  // namespace lacuna
