// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/base/random.hpp"
#include "diagnose/hypotheses/coloured_noise.hpp"
#include "diagnose/journey/answer.hpp"
#include "diagnose/journey/coefficient_changes.hpp"
#include "diagnose/journey/identifiability.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

// What a diagnosis may say of records that determine little.
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

/// The oscillator with the coefficient of v in dv/dt 0.1 lower and that of q 0.5 higher, on the
/// record q = sin 2t, v = 2 cos 2t, F = sin(3t) / 2.
Assimilation changed() {
  const OdeModel nominal = support::oscillator();
  std::vector<Equation> equations = nominal.equations();
  equations[1][0].coefficient += 0.5;
  equations[1][1].coefficient -= 0.1;
  const Trajectory record = support::oscillator_record().trajectories.front();
  const OdeModel model(nominal.states(), nominal.inputs(), equations, nominal.time_unit());
  Assimilation fit{.model = model,
                   .records = {linearise(model, record, record.states, Vector::Zero(2))},
                   .free = {{1, 0}, {1, 1}, {1, 2}}};
  fit.covariance = Vector{{0.04, 0.0004, 0.0}}.asDiagonal();
  return fit;
}

TEST(CoefficientChanges, MostSignificantFirst) {
  const auto changes = coefficient_changes(support::oscillator(), changed(), 3);
  ASSERT_EQ(changes.size(), 3u);
  EXPECT_EQ(changes[0].term, "v");
  EXPECT_NEAR(changes[0].sigma, 0.1 / 0.02, 1e-9);
  EXPECT_EQ(changes[1].term, "q");
  EXPECT_NEAR(changes[1].sigma, 0.5 / 0.2, 1e-9);
  EXPECT_EQ(changes[1].nominal, -4.0);
  EXPECT_EQ(changes[1].estimated, -3.5);
  EXPECT_EQ(changes[2].term, "F");
  EXPECT_EQ(changes[2].sigma, 0.0) << "no standard error is no significance";
}

TEST(CoefficientChanges, TwoThatTheRecordsDoNotDistinguishAreOffTogether) {
  Assimilation fit = changed();  // q by 0.5, v by -0.1
  fit.covariance.setZero();
  fit.covariance.diagonal() << 0.25, 0.01, 1.0;  // one deviation each
  EXPECT_FALSE(combined_change(support::oscillator(), fit, 3, 3.0)) << "two of chi squared 2";
  // Nearly -1 correlated: q + 5 v is determined and has not moved, q - 5 v is not determined.
  fit.covariance(0, 1) = fit.covariance(1, 0) = -0.999 * 0.5 * 0.1;
  EXPECT_FALSE(combined_change(support::oscillator(), fit, 3, 3.0));
  // Nearly 1 correlated: q - 5 v is determined, and has moved by 1.
  fit.covariance(0, 1) = fit.covariance(1, 0) = 0.999 * 0.5 * 0.1;
  const auto found = combined_change(support::oscillator(), fit, 3, 3.0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->first, "q");
  EXPECT_EQ(found->second, "v");
  EXPECT_NEAR(found->weight, -5.0, 1e-9);
  EXPECT_NEAR(found->nominal, -4.0 - 5.0 * -0.2, 1e-9);
  EXPECT_NEAR(found->estimated, found->nominal + 1.0, 1e-9);
  EXPECT_NEAR(found->deviation, std::sqrt(0.25 + 0.25 - 2.0 * 0.999 * 0.25), 1e-9);
  EXPECT_GT(found->sigma, 10.0);
  fit.covariance(2, 2) = 0.0;
  EXPECT_TRUE(combined_change(support::oscillator(), fit, 3, 3.0)) << "no error of the third";
  fit.covariance(1, 1) = 1e-6;
  fit.covariance(0, 1) = fit.covariance(1, 0) = 0.0;
  EXPECT_FALSE(combined_change(support::oscillator(), fit, 3, 3.0)) << "v is off by itself";
}

TEST(CoefficientChanges, WhatWasHeldHasNoError) {
  Assimilation fit = changed();
  fit.held = Matrix::Zero(3, 1);
  fit.held(1, 0) = 1.0;
  const auto changes = coefficient_changes(support::oscillator(), fit, 3);
  EXPECT_EQ(changes[0].term, "q") << "of v nothing is known";
  for (const CoefficientChange& change : changes) {
    EXPECT_EQ(change.determined, change.term != "v");
    EXPECT_EQ(change.deviation == 0.0, change.term != "q");
  }
  EXPECT_FALSE(with_intervals(fit).equations()[1][1].ci95.has_value());
  EXPECT_TRUE(with_intervals(fit).equations()[1][0].ci95.has_value());
}

TEST(CoefficientChanges, TheLargestIsTheRateThatMoves) {
  const Assimilation fit = changed();
  // 0.5 q - 0.1 v along q = sin 2t over the rate of v = 2 cos 2t, both by their integrals.
  double change = 0.0, rate = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double t = 1e-4 * (i + 0.5), q = std::sin(2.0 * t), v = 2.0 * std::cos(2.0 * t);
    change += std::pow(0.5 * q - 0.1 * v, 2);
    rate += std::pow(4.0 * q, 2);
  }
  const double found = largest_rate_change(support::oscillator(), fit);
  const Vector rates = rate_rms(fit);
  EXPECT_NEAR(found * rates[1], std::sqrt(change / 100000.0), 2e-3);
  EXPECT_NEAR(rates[1], std::sqrt(rate / 100000.0), 2e-2);
  EXPECT_GT(found, 0.0);
  EXPECT_EQ(largest_rate_change(fit.model, fit), 0.0) << "nothing moved";
}

/// A baseline of the oscillator, with hidden states as it may be.
Baseline base_of(const support::Asked& asked, std::vector<bool> hidden) {
  Baseline base = *asked.baseline();
  base.fit_options.hidden = std::move(hidden);
  return base;
}

Assimilation holding(const Baseline& base, const Vector& direction) {
  Assimilation fit = base.fitted;
  fit.held = direction;
  return fit;
}

TEST(Identifiability, AUnitIsKept) {
  const support::Asked asked = support::asked(support::nothing);
  const Baseline base = base_of(asked, {false, true});
  Assimilation fit = holding(base, Vector{{std::sqrt(0.5), 0.0, -std::sqrt(0.5)}});
  for (const Index unit : {0, 2}) {
    fit.units = {unit};
    const auto hints = identifiability_hints(asked.problem(), base, fit);
    ASSERT_FALSE(hints.empty());
    const CoefficientPlace& place = fit.free[static_cast<std::size_t>(unit)];
    const std::string kept =
        fit.model.equations()[1][static_cast<std::size_t>(place.term)].term.name() +
        " in dv/dt is kept as the model gives it";
    EXPECT_NE(hints.front().message.find("only as their product: " + kept), std::string::npos)
        << hints.front().message;
  }
}

}  // namespace
}  // namespace lacuna
