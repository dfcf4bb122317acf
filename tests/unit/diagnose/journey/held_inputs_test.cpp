// SPDX-License-Identifier: MIT
#include "diagnose/journey/held_inputs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "core/base/random.hpp"
#include "diagnose/hypotheses/input_holds.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/asked.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

/// q'' = -12 q - 0.5 q' + 8 u: a mass on a spring without the element.
OdeModel without_element() {
  return parse_model(R"({"format": "lacuna.model/1", "time_unit": "s",
    "states": [{"name": "q", "unit": "m"}, {"name": "w", "unit": "m/s"}],
    "inputs": [{"name": "u", "unit": "V"}],
    "equations": [
      {"state": "q", "terms": [{"term": "w", "coefficient": 1.0}]},
      {"state": "w", "terms": [{"term": "q", "coefficient": -12.0},
        {"term": "w", "coefficient": -0.5}, {"term": "u", "coefficient": 8.0}]}]})",
                     "test");
}

/// Twelve sines between 0.1 and 2 Hz, sampled every 10 ms.
double multisine(double t) {
  double sum = 0.0;
  for (int k = 0; k < 12; ++k) {
    const double frequency = 0.1 * std::pow(20.0, k / 11.0);
    sum += std::sin(2.0 * std::numbers::pi * frequency * t + 1.3 * k * k);
  }
  return 0.9 * sum;
}

/// The mass also moves a dashpot by another spring (Maxwell's element): dz/dt = w - z/0.4 adds
/// -6 z to dw/dt.
Dataset element_record(double noise) {
  constexpr Index kSamples = 2500;
  const OdeModel model = without_element();
  Dataset data;
  data.states = model.states();
  data.inputs = model.inputs();
  data.time_unit = "s";
  Trajectory& record = data.trajectories.emplace_back();
  record.time = Vector::LinSpaced(kSamples, 0.0, 0.01 * (kSamples - 1));
  record.states.resize(kSamples, 2);
  record.inputs.resize(kSamples, 1);
  const auto rate = [](double t, const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x[1], -12.0 * x[0] - 0.5 * x[1] + 8.0 * multisine(t) - 6.0 * x[2],
                           x[1] - 2.5 * x[2]);
  };
  Random random(1);
  Eigen::Vector3d x(0.2, 0.0, 0.0);
  const double h = 0.001;
  for (Index i = 0; i < kSamples; ++i) {
    record.states(i, 0) = x[0] + noise * random.normal();
    record.states(i, 1) = x[1] + 3.0 * noise * random.normal();
    record.inputs(i, 0) = multisine(record.time[i]);
    for (int part = 0; part < 10; ++part) {
      const double t = record.time[i] + h * part;
      const Eigen::Vector3d a = rate(t, x), b = rate(t + 0.5 * h, x + 0.5 * h * a),
                            c = rate(t + 0.5 * h, x + 0.5 * h * b), d = rate(t + h, x + h * c);
      x += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
  }
  return data;
}

/// The nominal model lacks so much that it takes the smooth input for a held one; under that
/// hold no effect explains the records.
TEST(HeldInputs, AreJudgedAnewWhereSomethingIsLeftBesideTheEffects) {
  const support::Asked asked{.records = observed(element_record(0.003)),
                             .options = diagnosis_options({}, default_registry()),
                             .nominal = without_element()};
  const JudgedModel found = judge_holds(asked.problem(), standard_hypotheses());
  EXPECT_EQ(found.model->inputs()[0].hold, Hold::Smooth);
  EXPECT_TRUE(found.notes.empty());
  ASSERT_EQ(found.judged.best.named.size(), 1u);
  EXPECT_EQ(found.judged.best.named[0].name, "lag");
  EXPECT_FALSE(has_residual_structure(found.judged.best.left, asked.options.decision));
  EXPECT_EQ(found.judged.trail.front().hypothesis, "input-hold");
}

/// With a square of the force nothing disturbs the model: under another hold of the force only
/// as plain effects are sought.
TEST(HeldInputs, AreBoundedWhereNothingIsLeftToExplain) {
  const auto square = [](double t, double, double) {
    const double force =
        std::sin(1.7 * t) + 0.7 * std::sin(2.9 * t + 1.0) + 0.5 * std::sin(0.6 * t);
    return 0.3 * force * force;
  };
  const support::Asked asked{.records = observed(support::hidden_record(square, 0.005)),
                             .options = diagnosis_options({}, default_registry())};
  const JudgedModel found = judge_holds(asked.problem(), standard_hypotheses());
  EXPECT_EQ(found.model->inputs()[0].hold, Hold::Smooth);
  ASSERT_EQ(found.judged.best.named.size(), 1u);
  const auto& trail = found.judged.trail;
  const auto bounded = std::find_if(trail.begin(), trail.end(), [](const Rival& rival) {
    return rival.hypothesis == "input-hold" && rival.rule.starts_with("bounded");
  });
  ASSERT_NE(bounded, trail.end());
  EXPECT_FALSE(bounded->taken);
  EXPECT_GT(bounded->value, bounded->threshold);
}

/// A filter of first order behind a smooth input that comes late: its exact answer to five
/// tones, of which no single one stands for the delay.
Dataset behind_a_late_input(const OdeModel& filter, double late) {
  constexpr double kStep = 0.1, kRate = 0.5;  // of the filter
  Random random(8);
  Trajectory record;
  record.time = Vector::LinSpaced(800, 0.0, 799 * kStep);
  record.states = Matrix::Zero(800, 1);
  record.inputs = Matrix::Zero(800, 1);
  for (const double w : {0.4, 0.7, 1.3, 1.9, 2.6}) {
    const double gain = kRate / std::hypot(kRate, w), lag = std::atan2(w, kRate);
    record.inputs.col(0).array() += (w * record.time.array()).sin();
    record.states.col(0).array() += gain * (w * (record.time.array() - late) - lag).sin();
  }
  for (double& x : record.states.reshaped()) x += 1e-4 * random.normal();
  return support::one_record(filter.states(), filter.inputs(), record);
}

/// A hold is half a step of delay, and a delay of 0.6 steps beside it one of 0.1: as no sample
/// repeats another, effects are sought beside the smooth input too.
TEST(HeldInputs, AreAskedAnewWhereNoSampleShowsThatTheyAreHeld) {
  const OdeModel filter = parse_ode("input u\ndx/dt = 0.5*u - 0.5*x\n", "made");
  support::Asked asked{.records = observed(behind_a_late_input(filter, 0.06)),
                       .options = diagnosis_options({}, default_registry())};
  asked.nominal = filter;
  EXPECT_EQ(choose_holds(asked.problem()).model.inputs()[0].hold, Hold::Zero);
  const JudgedModel found = judge_holds(asked.problem(), standard_hypotheses());
  EXPECT_EQ(found.model->inputs()[0].hold, Hold::Smooth);
  ASSERT_EQ(found.judged.best.named.size(), 1u);
  EXPECT_EQ(found.judged.best.named[0].name, "delay");
  EXPECT_NEAR(found.judged.best.explanation.effects[0].shapes[0], 0.06, 6e-4);
}

TEST(HeldInputs, AreNotTakenForMoreEffectsWhereFewerLeaveNothing) {
  const support::Asked asked{.records =
                                 observed(support::hidden_record(support::nothing, 0.01))};
  const DecisionOptions& decision = asked.options.decision;
  CompositeModel one = asked.bare(), three = one, two_and_a_rest = one;
  one.named.resize(1);
  three.named.resize(3);
  two_and_a_rest.named.resize(2);
  two_and_a_rest.left = {{.equation = 0, .sigma = 50.0, .relative = 0.2}};
  EXPECT_TRUE(is_less_plain(three, one, decision));
  EXPECT_FALSE(is_less_plain(one, three, decision));
  EXPECT_FALSE(is_less_plain(three, three, decision));
  EXPECT_FALSE(is_less_plain(three, two_and_a_rest, decision));
}

}  // namespace
}  // namespace lacuna
