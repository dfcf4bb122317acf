// SPDX-License-Identifier: MIT
// What a diagnosis may say of records that determine little.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/base/random.hpp"
#include "diagnose/hypotheses/coloured_noise.hpp"
#include "diagnose/journey/answer.hpp"
#include "lacuna/diagnose/journey/diagnose.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

DiagnosisOptions options() {
  DiagnosisOptions result;
  result.effects = support::own_effects();
  return result;
}

/// Samples of states under an input, made by f(i) = {states..., input}.
template <class Row>
Dataset record_of(std::vector<Quantity> states, Index samples, double step, Row row) {
  const auto m = static_cast<Index>(states.size());
  Dataset data{"s", std::move(states), {{"u", ""}}, {}, {}};
  Trajectory record{"made", Vector::LinSpaced(samples, 0.0, step * double(samples - 1)),
                    Matrix(samples, m), Matrix(samples, 1), Matrix()};
  for (Index i = 0; i < samples; ++i) {
    const std::vector<double> values = row(i);
    for (Index k = 0; k < m; ++k) record.states(i, k) = values[static_cast<std::size_t>(k)];
    record.inputs(i, 0) = values.back();
  }
  data.trajectories = {record};
  return data;
}

/// A body that friction holds, pushed to and fro in vain: place and speed are noise.
Dataset held_body(Index samples) {
  Random random(7);
  return record_of({{"x", "m"}, {"v", "m/s"}}, samples, 0.04, [&](Index i) {
    return std::vector{0.8 + 2e-4 * random.normal(), 3e-3 * random.normal(),
                       i % 10 < 5 ? 0.2 : -0.2};
  });
}

TEST(AdmitVerdict, FewSamplesInWhichNothingMovesDetermineNoCoefficient) {
  const OdeModel pushed =
      parse_ode("time s\ninput u\nstate x\nstate v\ndx/dt = v\ndv/dt = -0.4*v + 2*u\n", "made");
  const Diagnosis diagnosis = diagnose(pushed, held_body(25), {}, options());
  EXPECT_EQ(diagnosis.verdict, Verdict::Undetermined) << to_string(diagnosis.verdict);
  EXPECT_EQ(diagnosis.admission.standing, Standing::Undetermined);
  EXPECT_TRUE(diagnosis.effects.empty());
}

TEST(AdmitVerdict, ACountThatFlipsIsNoMotion) {
  const Dataset resting = record_of({{"x", "m"}, {"v", "m/s"}}, 25, 0.04, [](Index i) {
    const bool flips = i == 4 || i == 9 || i == 10;
    return std::vector{flips ? 0.802 : 0.8, 0.0, i % 10 < 5 ? 0.2 : -0.2};
  });
  const OdeModel pushed = parse_ode(
      "time s\ninput u\nstate x\nstate v\ndx/dt = v\ndv/dt = -0.4*v + 0.01*u\n", "made");
  const Diagnosis diagnosis = diagnose(pushed, resting, {}, options());
  EXPECT_EQ(diagnosis.verdict, Verdict::Undetermined) << to_string(diagnosis.verdict);
}

/// dh/dt = g u - 0.05 h, h measured with noise; g is 0.02, and later another one.
Dataset pump(double later) {
  Random noise(5), levels(6);
  double h = 4.0, u = 0.0;
  constexpr Index kSamples = 400;
  constexpr double kLoss = 0.05;
  return record_of({{"h", "cm"}}, kSamples, 1.0, [&](Index i) {
    if (i % 25 == 0) u = 0.5 + 2.5 * levels.uniform();
    const double shown = h + 0.01 * noise.normal();
    const double rest = (i < kSamples / 2 ? 0.02 : later) * u / kLoss;
    h = rest + (h - rest) * std::exp(-kLoss);
    return std::vector{shown, u};
  });
}

TEST(AdmitVerdict, WhatRemembersAsLongAsTheRecordIsNoNoise) {
  const OdeModel model =
      parse_ode("time s\ninput u hold zero\nstate h\ndh/dt = -0.05*h + 0.02*u\n", "made");
  DiagnosisOptions without_effects;
  without_effects.effects = {};
  const Diagnosis changed = diagnose(model, pump(0.012), {}, without_effects);
  EXPECT_EQ(changed.verdict, Verdict::Undetermined) << to_string(changed.verdict);
  EXPECT_GT(longest_memory(changed.noise, 0.1), 100.0) << "a third of the part that was used";
  ASSERT_TRUE(changed.gap.has_value());
  const Vector shown = changed.gap->runs.front().measured.col(0);
  const double spread = std::sqrt((shown.array() - shown.mean()).square().mean());
  EXPECT_NEAR(changed.gap->noise_floor * spread, 0.01, 0.002) << "what remembers is no noise";
  const Diagnosis same = diagnose(model, pump(0.02), {}, without_effects);
  EXPECT_EQ(same.verdict, Verdict::NoDiscrepancy) << to_string(same.verdict);
}

/// A made diagnosis: no coefficient is off by more than its error, and the fit is better.
Diagnosis made(Verdict verdict) {
  const OdeModel model = parse_ode("time s\nstate x\ndx/dt = -x + 0.1*x^2\n", "made");
  Diagnosis diagnosis{verdict, model, {}, {}, {}, {}, {}, model, {}, {}, {}, {}};
  diagnosis.coefficient_changes = {{0, "x", -1.0, -0.9, 0.06, 1.7},
                                   {0, "x^2", 0.1, 0.05, 0.03, 1.7}};
  diagnosis.disagreement = {{0, 0.2, 0.1, 2.0, 1.0, 0.5, {}}};
  return diagnosis;
}

TEST(AdmitVerdict, CoefficientsAreOffOnlyWhereOneIs) {
  Diagnosis none = made(Verdict::CoefficientsOnly);
  admit_verdict(none, {}, 10.0);
  EXPECT_EQ(none.verdict, Verdict::Undetermined);
  ASSERT_EQ(none.smallest_effects.size(), 1u);
  EXPECT_DOUBLE_EQ(none.smallest_effects[0].rate, 3.0 * 0.1);
  EXPECT_DOUBLE_EQ(none.smallest_effects[0].relative, 3.0 * 0.1 * 0.5 / 0.2);
  Diagnosis one = made(Verdict::CoefficientsOnly);
  one.coefficient_changes[0].sigma = 12.0;
  admit_verdict(one, {}, 10.0);
  EXPECT_EQ(one.verdict, Verdict::CoefficientsOnly);
  EXPECT_TRUE(one.smallest_effects.empty());
  Diagnosis pair = made(Verdict::CoefficientsOnly);
  pair.combined_change = CombinedChange{.first = "x", .second = "x^2", .weight = 2.0};
  admit_verdict(pair, {}, 10.0);
  EXPECT_EQ(pair.verdict, Verdict::CoefficientsOnly) << "a named combination";
  Diagnosis together = made(Verdict::CoefficientsOnly);
  together.coefficient_changes[1].determined = false;
  admit_verdict(together, {}, 10.0);
  EXPECT_EQ(together.verdict, Verdict::CoefficientsOnly) << "it moved with others";
}

TEST(AdmitVerdict, WhatHasAMemoryIsNoiseWhereAVerdictStandsOnIt) {
  const auto floor_with = [](Verdict verdict) {
    Diagnosis diagnosis = made(verdict);
    diagnosis.gap = Gap{"rms", 0.9, 0.6, 0.5, 2.0, 1.0, {"r2.csv"}};
    diagnosis.gap->white_floor = 0.1;
    diagnosis.gap->above_white_floor = 20.0;
    admit_verdict(diagnosis, {}, 10.0);
    return std::pair{diagnosis.gap->noise_floor, diagnosis.gap->above_floor};
  };
  EXPECT_EQ(floor_with(Verdict::NoDiscrepancy), (std::pair{0.5, 2.0}));
  EXPECT_EQ(floor_with(Verdict::Explained), (std::pair{0.5, 2.0}));
  EXPECT_EQ(floor_with(Verdict::UnnamedStructure), (std::pair{0.1, 20.0}));
  EXPECT_EQ(floor_with(Verdict::CoefficientsOnly), (std::pair{0.1, 20.0})) << "undetermined";
}

TEST(AdmitVerdict, SlowNoiseIsCompared) {
  const auto verdict_with = [](Verdict verdict, double time, double deviation) {
    Diagnosis diagnosis = made(verdict);
    diagnosis.noise.measurement = {0.1};
    diagnosis.noise.coloured = {ColouredNoise{deviation, time}};
    admit_verdict(diagnosis, {}, 10.0);
    return diagnosis.verdict;
  };
  EXPECT_EQ(verdict_with(Verdict::NoDiscrepancy, 2.0, 1.0), Verdict::NoDiscrepancy);
  EXPECT_EQ(verdict_with(Verdict::NoDiscrepancy, 5.0, 1.0), Verdict::Undetermined);
  EXPECT_EQ(verdict_with(Verdict::Explained, 5.0, 1.0), Verdict::Undetermined);
  EXPECT_EQ(verdict_with(Verdict::PartlyExplained, 5.0, 1.0), Verdict::Undetermined);
  EXPECT_EQ(verdict_with(Verdict::NoDiscrepancy, 5.0, 0.001), Verdict::NoDiscrepancy)
      << "next to none";
}

}  // namespace
}  // namespace lacuna
