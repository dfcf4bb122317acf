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

TEST(Augment, EffectsStandBehindTheNominalTermsAndAreFree) {
  const AugmentedProblem made =
      augmented({fitted(support::plain_candidate("sign(v)")),
                 fitted(support::stop_candidate(0.0), Vector::Constant(1, 0.25), 2.0)});
  EXPECT_EQ(made.effect_places, (std::vector<CoefficientPlace>{{1, 3}, {1, 4}}));
  EXPECT_EQ(made.free.size(), 5u) << "three nominal ones and two of effects";
  EXPECT_EQ(made.free.back(), (CoefficientPlace{1, 4}));
  EXPECT_EQ(made.model.coefficient(1, "sign(v)"), -0.3);
  EXPECT_EQ(made.model.equations()[1][4].term.expression(), parse_expression("min(q-0.25,0)"));
  EXPECT_EQ(made.model.equations()[1][4].coefficient, 2.0);
}

TEST(Augment, WhatIsMeasuredGetsASummandAndTheModelNone) {
  Candidate skew = support::plain_candidate("v");
  skew.place = Place::Channel;
  skew.equation = 0;
  const AugmentedProblem made = augmented({fitted(skew, Vector(0), 0.01)});
  EXPECT_EQ(made.model.equations()[0].size(), 1u);
  ASSERT_EQ(made.channel_terms.size(), 1u);
  EXPECT_EQ(made.channel_terms[0].state, 0);
  EXPECT_EQ(made.channel_terms[0].form, parse_expression("v"));
  EXPECT_EQ(made.channel_terms[0].coefficient, 0.01);
  EXPECT_EQ(made.free.size(), 3u) << "its coefficient is not one of the model";
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
