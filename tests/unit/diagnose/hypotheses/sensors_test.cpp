// SPDX-License-Identifier: MIT
// Faults of sensors in the place of effects, and beside them; channels that are late.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/base/random.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/effects/effects.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/held_oscillator.hpp"
#include "support/one_record.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

// Faults of sensors in the place of effects, and beside them.
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
  const support::Asked asked = with_sensor(1, [](double v, double) { return v + 0.2; });
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

inline constexpr StageInfo kSkew{"skew", "A skew for tests", ""};

/// v is measured with a summand of sign(v).
class Skew final : public Configured<Effect, EffectOptions<kSkew>> {
  std::string_view do_typical_cause() const override { return "a test"; }
  std::vector<Candidate> do_candidates(const Scope&, Index equation) const override {
    if (equation != 1) return {};
    Candidate candidate = support::plain_candidate("sign(v)");
    candidate.place = Place::Channel;
    return {candidate};
  }
};

/// A composite model of records with dry friction that blames the sensor of v and leaves
/// structure.
CompositeModel with_fault(const support::Asked& asked) {
  CompositeModel best = asked.bare();
  const Candidate skew = Skew().candidates(best.base->scope, 1).front();
  best.explanation =
      explain_on(asked.problem(), *best.base, best.base->fitted, {{skew, Vector(0), 0.0, 0.0}});
  best.named = {{.equation = 1, .name = "skew"}};
  best.rounds = {{7, "skew", 9.0, true}};
  best.left = {{1, 100.0, 9.0, 1.0, 0.5}};
  return best;
}

support::Asked friction() {
  support::Asked asked = support::asked(support::dry_friction, 0.01, support::own_effects());
  asked.options.effects.push_back(Skew());
  return asked;
}

TEST(SensorFault, DynamicsThatExplainMostTakeItsPlace) {
  const support::Asked asked = friction();
  const Proposals made = SensorFault().propose(asked.problem(), with_fault(asked));
  ASSERT_EQ(made.composites.size(), 1u);
  const CompositeModel& composite = made.composites[0].composite;
  EXPECT_EQ(composite.hypothesis, "sensor-fault");
  ASSERT_EQ(composite.named.size(), 1u);
  EXPECT_EQ(composite.named[0].name, "dry");
  EXPECT_TRUE(composite.explanation.fit.channel_terms.empty());
  EXPECT_EQ(composite.rounds.front().tried, 7) << "the rounds before come first";
  EXPECT_TRUE(std::holds_alternative<ByRule>(made.composites[0].judged));
}

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
  const Diagnosis found = diagnose(support::oscillator(), humming(3, 0.4, 0.5),
                                   humming(4, 2.5, -0.6), DiagnosisOptions{}, RunContext{});
  ASSERT_EQ(found.effects.size(), 1u);
  EXPECT_EQ(found.effects[0].name, "sensor-offset");
  EXPECT_EQ(found.verdict, Verdict::Explained);
}

/// A composite model that says an effect.
CompositeModel that_says(const support::Asked& asked, const Candidate& candidate,
                         const std::string& name) {
  CompositeModel best = asked.bare();
  const Vector shapes = candidate.starts.front();
  best.explanation = explain_on(asked.problem(), *best.base, best.base->fitted,
                                {{candidate, shapes, 1.0, 0.0}});
  best.named = {{.equation = 1, .name = name, .probability = 0.9}};
  return best;
}

/// One channel of a linear system: its sensor and its only input that lag are one to it.
TEST(SensorTiming, WhereOneChannelShowsAllBothAreSaid) {
  support::Asked asked{.records = {}, .nominal = parse_ode("input u\ndx/dt = -1.2*x + u", "")};
  Trajectory record;
  record.source = "made";
  record.time = Vector::LinSpaced(1501, 0.0, 30.0);
  record.states.resize(1501, 1);
  record.inputs.resize(1501, 1);
  Random random(5);
  double x = 0.0, late = 0.0;
  constexpr double kStep = 0.02, kTau = 0.2;
  const auto input = [](double t) { return std::sin(2.0 * t) + std::sin(0.7 * t * t / 10.0); };
  for (Index i = 0; i < 1501; ++i) {
    record.states(i, 0) = x + 0.002 * random.normal();
    record.inputs(i, 0) = input(record.time[i]);
    for (int part = 0; part < 100; ++part) {
      const double h = kStep / 100.0, t = record.time[i] + h * (part + 0.5);
      const double middle = late + 0.5 * h * (input(t) - late) / kTau;
      x += h * (middle - 1.2 * x);
      late += h * (input(t) - middle) / kTau;
    }
  }
  Dataset data = support::one_record({{"x", ""}}, {{"u", ""}}, record);
  asked.records = observed(data);
  Candidate lag{.form = parse_expression("lagged-u"), .argument = parse_expression("u")};
  lag.memory = {{"lagged", parse_expression("(u-lagged)/tau"), parse_expression("u")}};
  lag.shapes = {{"tau", asked.nominal.time_unit(), 0.01, 5.0, true}};
  lag.starts = {Vector::Constant(1, 0.2)};
  CompositeModel best = that_says(asked, lag, "lag");
  best.named[0].equation = 0;
  const Proposals made = SensorTiming().propose(asked.problem(), best);
  ASSERT_EQ(made.composites.size(), 1u);
  const CompositeModel& both = made.composites[0].composite;
  EXPECT_FALSE(both.twins.empty());
  ASSERT_EQ(both.named.size(), 1u);
  EXPECT_FALSE(both.named[0].alternatives.empty());
}

// Inputs that are recorded late: the time of their samples is told, and nothing in its place.
/// The force of hidden_record() as it was so long ago.
Dataset late_force(Dataset data, double late) {
  for (Trajectory& record : data.trajectories)
    for (Index i = 0; i < record.time.size(); ++i) {
      const double t = record.time[i] - late;
      record.inputs(i, 0) =
          std::sin(1.7 * t) + 0.7 * std::sin(2.9 * t + 1.0) + 0.5 * std::sin(0.6 * t);
    }
  return data;
}

support::Asked asked_of(const Dataset& data) { return {.records = observed(data)}; }

std::vector<Proposal> moved_ahead_in(const support::Asked& asked) {
  return InputSkew{}.propose(asked.problem(), asked.bare()).composites;
}

class LateForce : public ::testing::TestWithParam<double> {};

TEST_P(LateForce, IsMovedAhead) {
  const double late = GetParam();
  const auto composites = moved_ahead_in(
      asked_of(late_force(support::hidden_record(support::nothing, 2e-3), late)));
  ASSERT_EQ(composites.size(), 1u);
  EXPECT_TRUE(composites[0].search_first);
  const CompositeModel& composite = composites[0].composite;
  ASSERT_EQ(composite.findings.size(), 1u);
  const NamedEffect& found = composite.findings[0];
  EXPECT_EQ(found.name, "channel-skew");
  EXPECT_EQ(found.equation, 1);
  EXPECT_NEAR(found.parameters.at(0).value, late, 1e-3);
  EXPECT_NEAR(found.coefficient, late, 1e-3) << "the force acts with coefficient 1";
  ASSERT_GT(found.deviation, 0.0);
  EXPECT_LT(std::abs(found.coefficient - late), 4.0 * found.deviation + 1e-4);
  EXPECT_LT(found.deviation, 1e-3);
  EXPECT_GT(found.gap_closed, 0.99);
  EXPECT_FALSE(leaves_structure(composite, DecisionOptions{}));
  // Other records are moved alike.
  const Dataset other =
      composite.base->correct(support::hidden_record(support::nothing, 0.0, 4));
  const Dataset ahead =
      late_force(support::hidden_record(support::nothing, 0.0, 4), -found.parameters[0].value);
  const Index inner = other.trajectories[0].time.size() - 20;
  EXPECT_LT((other.trajectories[0].inputs - ahead.trajectories[0].inputs)
                .topRows(inner)
                .cwiseAbs()
                .maxCoeff(),
            1e-5);
}

INSTANTIATE_TEST_SUITE_P(Steps, LateForce, ::testing::Values(0.01, 0.02, 0.05, 0.073),
                         [](const auto& late) {
                           return std::to_string(std::lround(1000 * late.param)) + "ms";
                         });

TEST(InputSkew, NothingIsProposedOfAForceThatIsInTimeOrEarly) {
  const Dataset in_time = support::hidden_record(support::nothing, 2e-3);
  EXPECT_TRUE(moved_ahead_in(asked_of(in_time)).empty());
  EXPECT_TRUE(moved_ahead_in(asked_of(late_force(in_time, -0.05))).empty())
      << "a delay of the plant";
  EXPECT_TRUE(
      moved_ahead_in(asked_of(support::hidden_record(support::dry_friction, 2e-3))).empty());
}

TEST(InputSkew, TheStandardErrorIsTheScatterOfTheTime) {
  constexpr int kDraws = 24;
  double scatter = 0.0, said = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Dataset data = support::hidden_record(support::nothing, 1e-2, 100 + draw);
    const auto composites = moved_ahead_in(asked_of(late_force(data, 0.05)));
    ASSERT_EQ(composites.size(), 1u);
    const NamedParameter& lead = composites[0].composite.findings.at(0).parameters.at(0);
    scatter += std::pow(lead.value - 0.05, 2) / kDraws;
    said += std::pow(lead.deviation.value(), 2) / kDraws;
  }
  EXPECT_NEAR(std::sqrt(scatter / said), 1.0, 0.25);
}

TEST(InputSkew, NoiseOfTheForceIsNoTimeOfIt) {
  Dataset noisy = support::hidden_record(support::nothing, 1e-3);
  Random random(8);
  for (double& force : noisy.trajectories[0].inputs.reshaped()) force += 0.2 * random.normal();
  const support::Asked asked = asked_of(noisy);
  ASSERT_TRUE(leaves_structure(asked.bare(), asked.options.decision) ||
              asked.bare().explanation.fit.noise.disturbance[1] > 0.0);
  EXPECT_TRUE(moved_ahead_in(asked).empty());
}

TEST(InputSkew, HeldInputsAreLateByWholeSteps) {
  Dataset data = support::held_record(Hold::Zero, 1e-3);
  Trajectory& record = data.trajectories.front();
  const Index n = record.time.size() - 3;
  const Vector before = record.inputs.col(0).head(n);
  record.inputs.col(0).tail(n) = before;
  support::Asked asked = asked_of(data);
  asked.nominal = asked.nominal.with_holds({Hold::Zero});
  const auto composites = moved_ahead_in(asked);
  ASSERT_EQ(composites.size(), 1u);
  const CompositeModel& composite = composites[0].composite;
  EXPECT_NEAR(composite.findings.at(0).parameters.at(0).value, 0.06, 1e-9);
  const Vector moved = composite.base->correct(data).trajectories[0].inputs.col(0);
  EXPECT_EQ(moved.head(n), record.inputs.col(0).tail(n));
}

}  // namespace
}  // namespace lacuna
