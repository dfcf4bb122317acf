// SPDX-License-Identifier: MIT
// What a diagnosis takes records, starts, outputs and places from.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "diagnose/journey/explained_records.hpp"
#include "diagnose/journey/fitted_outputs.hpp"
#include "diagnose/journey/fitted_start.hpp"
#include "diagnose/journey/locate.hpp"
#include "diagnose/journey/output_channels.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/driven_oscillator.hpp"
#include "support/grey_box.hpp"
#include "support/own_effects.hpp"
#include "trajectories/smoother/spectral_lines.hpp"

namespace lacuna {
namespace {

// A diagnosis that is not done to its end.
TEST(DiagnosisEffort, PastTheDeadlineTheAnswerIsThatTheSearchIsNotFinished) {
  RunContext context;
  context.deadline = std::chrono::steady_clock::now();
  DiagnosisOptions options;
  options.effects = support::own_effects();
  const Diagnosis diagnosis =
      diagnose(support::oscillator(), support::hidden_record(support::dry_friction, 0.01, 3),
               support::hidden_record(support::dry_friction, 0.01, 4, -0.7), options, context);
  EXPECT_EQ(diagnosis.verdict, Verdict::Incomplete);
  EXPECT_EQ(diagnosis.admission.standing, Standing::Incomplete);
  EXPECT_NE(diagnosis.admission.why.find("effects"), std::string::npos);
  EXPECT_TRUE(diagnosis.effects.empty());
  EXPECT_FALSE(diagnosis.gap.has_value());
  EXPECT_EQ(answer_from(diagnosis.stages), "coefficients");
  EXPECT_EQ(diagnosis.notes.back(), left_out_line(diagnosis.stages));
}

TEST(DiagnosisEffort, WhatAQuickRunNamesIsNoWholeExplanation) {
  DiagnosisOptions options;
  options.effects = support::own_effects();
  options.effort = Thoroughness::Quick;
  const Diagnosis diagnosis =
      diagnose(support::oscillator(), support::hidden_record(support::dry_friction, 0.01, 3),
               support::hidden_record(support::dry_friction, 0.01, 4, -0.7), options, {});
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects[0].name, "dry");
  EXPECT_EQ(diagnosis.verdict, Verdict::PartlyExplained);
  EXPECT_NE(left_out_line(diagnosis.stages).find("other assumptions"), std::string::npos);
}

TEST(DiagnosisEffort, ThatNoKnownEffectExplainsTheRecordsIsNoAnswerOfAQuickRun) {
  DiagnosisOptions options;
  options.effects = {};
  const auto diagnosed = [&](Thoroughness effort) {
    options.effort = effort;
    return diagnose(support::oscillator(),
                    support::hidden_record(support::dry_friction, 0.01, 3),
                    support::hidden_record(support::dry_friction, 0.01, 4, -0.7), options, {})
        .verdict;
  };
  EXPECT_EQ(diagnosed(Thoroughness::Quick), Verdict::Incomplete);
  EXPECT_EQ(diagnosed(Thoroughness::Normal), Verdict::UnnamedStructure);
}

TEST(Locate, FindsTheRegionOfAStop) {
  const Assimilation fit = support::assimilated(support::hidden_record(
      [](double, double q, double) { return q > 0.4 ? -1.0 : 0.0; }, 0.005));
  const auto found = locate(fit, RunContext{});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].equation, 1);
  EXPECT_GT(found[0].sigma, 5.0);
  EXPECT_NEAR(found[0].fraction, 1.0, 1e-9);
  EXPECT_EQ(found[0].where[0].variable, "q");
}

TEST(Locate, FindsTheFrequencyOfAForcing) {
  const Assimilation fit = support::assimilated(support::hidden_record(
      [](double t, double, double) {
        return 0.2 * std::sin(2.0 * std::numbers::pi * 1.3 * t + 0.7);
      },
      0.005));
  const auto lines = spectral_lines(fit, 1);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].frequency, 1.3, 0.02);
  EXPECT_NEAR(std::remainder(lines[0].phase - 0.7, 2.0 * std::numbers::pi), 0.0, 0.6);
  const auto found = locate(fit, RunContext{});
  ASSERT_TRUE(found[0].where[0].frequency.has_value());
  EXPECT_NEAR(*found[0].where[0].frequency, 1.3, 0.02);
}

/// The oscillator with every coefficient of dv/dt a factor off.
OdeModel off_by(double factor) {
  std::vector<Equation> equations = support::oscillator().equations();
  for (WeightedTerm& term : equations[1]) term.coefficient *= factor;
  return support::oscillator().with_equations(std::move(equations));
}

TEST(FittedStart, HasTheCoefficientsOfTheRecord) {
  const Dataset data = support::hidden_record(support::nothing, 0.01);
  const OdeModel nominal = off_by(1.6);
  const auto start = fitted_start(nominal, nominal, data, analyse_noise(data), RunContext{});
  ASSERT_TRUE(start);
  EXPECT_NEAR(start->coefficient(1, "q"), -4.0, 0.02);
  EXPECT_NEAR(start->coefficient(1, "v"), -0.2, 0.01);
  EXPECT_EQ(start->coefficient(0, "v"), 1.0);
}

TEST(FittedStart, KeepsOneOfTheNumbersThatAreKnownOnlyTogether) {
  const std::string text =
      "input u hold linear\ndp/dt = -0.5*p + 0.4*u\ndq/dt = 0.6*p - 0.8*q\n";
  const OdeModel truth = parse_ode(text + "y = q\n", "t.ode"),
                 nominal = parse_ode(text, "n.ode");
  Dataset columns =
      support::grey_box_columns(truth, {.start = Vector{{1.0, 1.0}}, .noise = 0.002});
  columns.states[0].name = "q";
  const Dataset data = model_view(nominal, columns, FiniteDifferences{});
  std::vector<Equation> equations = nominal.equations();
  for (Equation& equation : equations)
    for (WeightedTerm& term : equation) term.coefficient *= 1.3;
  const OdeModel off = nominal.with_equations(equations);
  const auto start = fitted_start(off, off, data, analyse_noise(data), RunContext{});
  ASSERT_TRUE(start);
  const double into = start->coefficient(0, "u"), through = start->coefficient(1, "p");
  EXPECT_NEAR(into * through, 0.24, 0.02) << "they are known as a product";
  EXPECT_TRUE(into == off.coefficient(0, "u") || through == off.coefficient(1, "p"));
}

TEST(FittedStart, IsNoneWhereThereIsNoTime) {
  const Dataset data = support::hidden_record(support::nothing, 0.01);
  const OdeModel nominal = off_by(1.6);
  RunContext late;
  late.deadline = std::chrono::steady_clock::now();
  EXPECT_FALSE(fitted_start(nominal, nominal, data, analyse_noise(data), late));
}

TEST(FittedStart, IsNoneWhereNoRunIsFinite) {
  const OdeModel oscillator = support::oscillator();
  const OdeModel wild = oscillator.with_term(
      1, {.term = Term::parse("sqrt(-1-q^2)", oscillator.variables()), .coefficient = 1.0});
  const Dataset data = support::hidden_record(support::nothing, 0.01);
  EXPECT_FALSE(fitted_start(wild, wild, data, analyse_noise(data), RunContext{}));
}

// Parameters that stand in outputs only.
/// A cell with one RC pair that nobody measures.
SystemModel cell(const std::string& voltage) {
  return parse_ode_system(
      "time s\ninput I [A] hold zero\nparam tau = 40\nparam C = 2500\n"
      "param R0 = 0.05\nparam U0 = 3.7\ndV/dt = I/C - V/tau\n"
      "U = " +
          voltage + " [V]\ninitial V = 0\n",
      "cell");
}

/// Its voltage with tau 50 s, C 2000 F, R0 0.06 Ohm, U0 3.65 V; exact steps of the held
/// current.
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

// Clocks of records that chose nothing.
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

/// An angle, its rate and a temperature, seen through an output.
OdeModel model_with(const std::string& output) {
  return parse_ode("dth/dt = w\ndw/dt = -th\ndT/dt = -T\n" + output + "\n", "test");
}

constexpr Index kReadings = 12;

/// 0, 1, 2, ...
Vector readings() { return Vector::LinSpaced(kReadings, 0.0, kReadings - 1.0); }

/// A reading and T, sample by sample.
Dataset view_of(const OdeModel& model, const Vector& reading) {
  Trajectory record;
  record.time = readings();
  record.states.resize(kReadings, 2);
  record.states << reading, readings();
  record.inputs.resize(kReadings, 0);
  return model_view(model,
                    {.time_unit = "s",
                     .states = {{"y", ""}, {"T", ""}},
                     .inputs = {},
                     .trajectories = {record},
                     .rate_of = {}},
                    FiniteDifferences{});
}

TEST(OutputChannels, RecordsAreThoseOfTheState) {
  const OdeModel model = model_with("y = 10 - 2*th");
  Dataset view = view_of(model, (10.0 - 2.0 * readings().array()).matrix());
  set_mark(view.trajectories.front(), 3, 3, Mark::AtBottom);
  const auto images = images_of_states(model, view);
  const OdeModel without = without_images(model, images);
  EXPECT_TRUE(without.outputs().empty());
  const Dataset seen = with_states_of(images, without, view);
  ASSERT_EQ(seen.state_count(), 3);
  const Trajectory& record = seen.trajectories.front();
  EXPECT_EQ(record.states.col(0), readings());
  EXPECT_EQ(record.states.col(2), readings());
  EXPECT_TRUE(seen.is_measured(0));
  EXPECT_FALSE(seen.is_measured(1)) << "the rate of th";
  EXPECT_NEAR(record.states(1, 1), 1.0, 1e-9);
  EXPECT_EQ(mark_of(record.marks, 3, 0), Mark::AtTop) << "the factor is negative";
  EXPECT_EQ(mark_of(record.marks, 2, 0), Mark::Value);
}

}  // namespace
}  // namespace lacuna
