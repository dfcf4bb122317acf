// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/diagnose/candidates/explanation.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

FittedEffect fitted(Candidate candidate, const Vector& shapes = Vector(0),
                    double coefficient = -0.3) {
  return {std::move(candidate), shapes, coefficient, 0.0};
}

/// z' = (q - z) / lag, z = 0 at first; the form is z.
Candidate lagging(const std::string& name) {
  Candidate candidate = support::plain_candidate(name);
  candidate.shapes = {{"lag", "s", 0.1, 10.0, true}};
  candidate.memory = {
      {name, parse_expression("(q-" + name + ")/lag"), parse_expression("0"), false}};
  return candidate;
}

AugmentedProblem augmented(const std::vector<FittedEffect>& effects) {
  const OdeModel nominal = support::oscillator();
  const Dataset data = support::oscillator_record();
  return augment(nominal, data, free_coefficients(nominal), effects,
                 {data.trajectories.front().states});
}

TEST(Augment, AMemoryIsAStateThatWasNotMeasuredWithItsSolution) {
  constexpr double kLag = 0.4;
  const AugmentedProblem made = augmented({fitted(lagging("z"), Vector::Constant(1, kLag))});
  ASSERT_EQ(made.model.dimension(), 3);
  EXPECT_EQ(made.data.states[2].name, "z");
  EXPECT_EQ(made.data.reconstructed, (std::vector<bool>{false, false, true}));
  const Trajectory& record = made.data.trajectories[0];
  // z' = (sin 2t - z) / T from z = 0: a sine behind the other, and what is left of the start.
  const double w = 2.0 * kLag, size = 1.0 / (1.0 + w * w);
  for (Index i = 0; i < record.samples(); i += 50) {
    const double t = record.time[i];
    const double z =
        size * (std::sin(2.0 * t) - w * std::cos(2.0 * t) + w * std::exp(-t / kLag));
    EXPECT_NEAR(record.states(i, 2), z, 2e-4) << t;
  }
}

}  // namespace
}  // namespace lacuna
