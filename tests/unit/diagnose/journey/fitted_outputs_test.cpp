// SPDX-License-Identifier: MIT
// Parameters that stand in outputs only.
#include "lacuna/diagnose/journey/fitted_outputs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna {
namespace {

/// A cell with one RC pair that nobody measures.
SystemModel cell(const std::string& voltage) {
  return parse_ode_system("time s\ninput I [A] hold zero\nparam tau = 40\nparam C = 2500\n"
                          "param R0 = 0.05\nparam U0 = 3.7\ndV/dt = I/C - V/tau\n"
                          "U = " + voltage + " [V]\ninitial V = 0\n",
                          "cell");
}

/// Its voltage with tau 50 s, C 2000 F, R0 0.06 Ohm, U0 3.65 V; exact steps of the held current.
Dataset measured_on(const SystemModel& model) {
  constexpr Index kSamples = 1200;
  Random random(4);
  Trajectory record;
  record.source = "made";
  record.time = Vector::LinSpaced(kSamples, 0.0, kSamples - 1.0);
  record.states.resize(kSamples, 1);
  record.inputs.resize(kSamples, 1);
  double v = 0.0, current = 0.0;
  for (Index i = 0; i < kSamples; ++i) {
    if (i % 70 == 0) current = random.uniform(-2.0, 2.0);
    record.inputs(i, 0) = current;
    record.states(i, 0) = 3.65 - 0.06 * current - v + 2e-4 * random.normal();
    const double end = current * 50.0 / 2000.0;
    v = end + (v - end) * std::exp(-1.0 / 50.0);
  }
  Dataset data;
  data.states = {{"U", "V"}};
  data.inputs = {{"I", "A"}};
  data.trajectories = {std::move(record)};
  return model_view(model.model(), data, FiniteDifferences{});
}

double value_of(const SystemModel& model, const std::string& name) {
  for (const Parameter& parameter : model.parameters())
    if (parameter.name == name) return parameter.value;
  return std::nan("");
}

TEST(FittedOutputs, AreThoseThatFitTheRecords) {
  const SystemModel given = cell("U0 - R0*I - V");
  const FittedOutputs found = with_fitted_outputs(given, measured_on(given), RunContext{});
  EXPECT_NEAR(value_of(found.model, "R0"), 0.06, 1e-4);
  EXPECT_NEAR(value_of(found.model, "U0"), 3.65, 1e-4);
  EXPECT_EQ(value_of(found.model, "tau"), 40.0) << "the diagnosis says what is off there";
  EXPECT_EQ(value_of(found.model, "C"), 2500.0);
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_NE(found.notes[0].find("R0 = 0.06"), std::string::npos) << found.notes[0];
  EXPECT_NE(found.notes[0].find("not 3.7"), std::string::npos) << found.notes[0];
}

TEST(FittedOutputs, ParametersOfEquationsStay) {
  const SystemModel given = cell("3.65 - tau/800*I - V");
  const FittedOutputs found = with_fitted_outputs(given, measured_on(given), RunContext{});
  EXPECT_EQ(value_of(found.model, "tau"), 40.0);
  EXPECT_TRUE(found.notes.empty());
}

TEST(FittedOutputs, WhatCannotBeFittedStays) {
  const SystemModel given = cell("U0 - R0*I - V");
  Dataset still = measured_on(given);
  for (Trajectory& record : still.trajectories) record.inputs.setZero();
  const FittedOutputs found = with_fitted_outputs(given, still, RunContext{});
  EXPECT_EQ(value_of(found.model, "R0"), 0.05) << "nothing flows";
}

}  // namespace
}  // namespace lacuna
