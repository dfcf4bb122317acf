// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "diagnose/hypotheses/sensor_fault.hpp"
#include "lacuna/effects/effect_family.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

/// A complete model whose sensor of a state shows something else.
template <class Show>
support::Asked with_sensor(Index state, Show show) {
  Dataset data = support::hidden_record(support::nothing, 0.005);
  Trajectory& record = data.trajectories.front();
  for (Index i = 0; i < record.samples(); ++i)
    record.states(i, state) = show(record.states(i, state), record.time[i]);
  return {.records = observed(data)};
}

Proposals proposed(const support::Asked& asked) {
  return SensorCalibration().propose(asked.problem(), asked.bare());
}

TEST(SensorCalibration, AConstantForceDoesAsWellAsAnOffset) {
  support::Asked asked = support::asked([](double, double, double) { return 0.4; }, 0.005);
  CompositeModel best = asked.bare();
  // the best composite model so far has the force
  Candidate force{.form = Expression::number(1.0),
                  .argument = Expression::number(1.0),
                  .starts = {Vector()},
                  .equation = 1};
  best.explanation =
      explain_on(asked.problem(), *best.base, best.base->fitted, {{force, Vector(), 0.4, 0.0}});
  best.named = {{.equation = 1, .name = "constant-offset", .probability = 0.9}};
  const Proposals made = SensorCalibration().propose(asked.problem(), best);
  ASSERT_EQ(made.composites.size(), 1u);
  const CompositeModel& composite = made.composites[0].composite;
  EXPECT_TRUE(std::holds_alternative<ByRule>(made.composites[0].judged));
  EXPECT_EQ(composite.twins.size(), 1u) << "neither is distinguished from the other";
  ASSERT_EQ(composite.named.size(), 1u);
  EXPECT_EQ(composite.named[0].name, "constant-offset") << "the dynamics lead";
  ASSERT_FALSE(composite.named[0].alternatives.empty());
  EXPECT_EQ(composite.named[0].alternatives[0].name, "sensor-offset");
}

TEST(SensorCalibration, TheTwinOfAnOffsetInTwoEquationsIsBothConstantsTogether) {
  const support::Asked asked =
      with_sensor(1, [](double v, double) { return v + 0.2; });
  CompositeModel best = asked.bare();
  std::vector<FittedEffect> constants;
  for (const Index equation : {0, 1}) {
    constants.push_back({{.form = Expression::number(1.0),
                          .argument = Expression::number(1.0),
                          .starts = {Vector()},
                          .equation = equation},
                         Vector(),
                         0.0,
                         0.0});
    best.named.push_back({.equation = equation, .name = "constant-offset", .term = "1"});
  }
  best.explanation = explain_on(asked.problem(), *best.base, best.base->fitted, constants);
  const Proposals made = SensorCalibration().propose(asked.problem(), best);
  ASSERT_EQ(made.composites.size(), 1u);
  const CompositeModel& composite = made.composites[0].composite;
  ASSERT_EQ(composite.named.size(), 1u);
  EXPECT_EQ(composite.named[0].name, "sensor-offset");
  ASSERT_EQ(composite.twins.size(), 1u) << "none of the two alone";
  EXPECT_EQ(composite.twins[0].what, "constant-offset in dq/dt with constant-offset in dv/dt");
  EXPECT_EQ(composite.twins[0].names, std::vector<std::string>{"constant-offset"});
  EXPECT_FALSE(composite.twins[0].measurement);
  ASSERT_FALSE(composite.named[0].alternatives.empty());
  EXPECT_EQ(composite.named[0].alternatives[0].term, "1 in dq/dt with 1 in dv/dt");
}

/// Dry friction seen by a channel that picks up the position.
support::Asked friction_and_crosstalk() {
  Dataset data = support::hidden_record(support::dry_friction, 0.005);
  Matrix& states = data.trajectories.front().states;
  states.col(1) += 0.1 * states.col(0);
  return {.records = observed(data)};
}

/// A composite model with effects of dv/dt without shapes, each named as its form.
CompositeModel with_effects(const support::Asked& asked,
                            const std::vector<std::string>& forms) {
  CompositeModel best = asked.bare();
  std::vector<FittedEffect> effects;
  for (const std::string& form : forms) {
    effects.push_back({support::plain_candidate(form), Vector(), 0.0, 0.0});
    effects.back().candidate.equation = 1;
    best.named.push_back({.equation = 1, .name = form, .probability = 0.9});
  }
  best.explanation = explain_on(asked.problem(), *best.base, best.base->fitted, effects);
  return best;
}

TEST(SensorCalibration, StandsBesideAnEffectInThePlaceOfAllOthers) {
  const support::Asked asked = friction_and_crosstalk();
  const Proposals made = SensorCalibration().propose(
      asked.problem(), with_effects(asked, {"q^3", "sign(v)", "F^2"}));
  ASSERT_EQ(made.composites.size(), 1u);
  const CompositeModel& composite = made.composites[0].composite;
  ASSERT_EQ(composite.named.size(), 2u);
  EXPECT_EQ(composite.named[0].name, "sensor-offset");
  EXPECT_EQ(composite.named[0].place, Place::Channel);
  EXPECT_NEAR(composite.named[0].coefficient, 0.1, 0.01);
  EXPECT_EQ(composite.named[1].name, "sign(v)");
  EXPECT_NEAR(composite.named[1].coefficient, -0.3, 0.01);
  EXPECT_FALSE(leaves_structure(composite, asked.options.decision));
}

TEST(SensorCalibration, AddsMoreThanSamplesAreRounded) {
  support::Asked asked = with_sensor(0, [](double q, double) { return q - 0.1; });
  asked.records.channels[0].noise.lattice = 0.34;  // rounded by 0.098 rms
  EXPECT_EQ(proposed(asked).composites.size(), 1u);
  asked.records.channels[0].noise.lattice = 0.36;  // by 0.104
  EXPECT_TRUE(proposed(asked).composites.empty());
}

}  // namespace
}  // namespace lacuna
