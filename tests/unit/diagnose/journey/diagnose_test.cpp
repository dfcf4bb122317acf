// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/diagnose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "effects/families.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

Diagnosis diagnosis_of(const support::Hidden& hidden) {
  DiagnosisOptions options;
  options.effects = support::own_effects();
  return diagnose(support::oscillator(), support::hidden_record(hidden, 0.01, 3),
                  support::hidden_record(hidden, 0.01, 4, -0.7), options, RunContext{});
}

TEST(Diagnose, NamesWhatIsMissing) {
  const Diagnosis diagnosis = diagnosis_of(support::dry_friction);
  EXPECT_EQ(diagnosis.verdict, Verdict::Explained);
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects[0].name, "dry");
  EXPECT_GT(diagnosis.effects[0].gap_closed, 0.9);
  EXPECT_NEAR(diagnosis.augmented.coefficient(1, "sign(v)"), -0.3, 0.02);
  EXPECT_FALSE(diagnosis.remaining.structure) << diagnosis.remaining.sigma;
  ASSERT_TRUE(diagnosis.gap.has_value());
  EXPECT_LT(diagnosis.gap->ratio(), 0.5);
}

TEST(Diagnose, ACompleteModelHasNoDiscrepancy) {
  const Diagnosis diagnosis = diagnosis_of(support::nothing);
  EXPECT_EQ(diagnosis.verdict, Verdict::NoDiscrepancy);
  EXPECT_TRUE(diagnosis.effects.empty());
}

TEST(Diagnose, AtRestNothingIsSaidOfTheModel) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    Dataset data = support::hidden_record(support::nothing, 0.0);
    Trajectory& record = data.trajectories[0];
    record.inputs.setZero();
    for (double& value : record.states.reshaped()) value = 0.01 * random.normal();
    const Diagnosis diagnosis = diagnose(support::oscillator(), data, {}, {}, RunContext{});
    EXPECT_EQ(diagnosis.verdict, Verdict::Undetermined) << seed;
    EXPECT_EQ(withheld_by(diagnosis.hints), Withheld::Claims) << seed;
    for (const CoefficientChange& change : diagnosis.coefficient_changes)
      EXPECT_EQ(change.estimated, change.nominal) << seed;
  }
}

TEST(Diagnose, WrongCoefficientsAreToldFromMissingStructure) {
  const Diagnosis diagnosis = diagnosis_of([](double, double q, double) { return 0.4 * q; });
  EXPECT_EQ(diagnosis.verdict, Verdict::CoefficientsOnly);
  ASSERT_FALSE(diagnosis.coefficient_changes.empty());
  EXPECT_EQ(diagnosis.coefficient_changes[0].term, "q");
  EXPECT_NEAR(diagnosis.coefficient_changes[0].estimated, -3.6, 0.02);
}

TEST(Diagnose, WhatNoCandidateExpressesIsNotNamed) {
  const Diagnosis diagnosis =
      diagnosis_of([](double t, double, double) { return 0.5 * std::sin(5.0 * t); });
  EXPECT_EQ(diagnosis.verdict, Verdict::UnnamedStructure);
  EXPECT_TRUE(diagnosis.effects.empty());
  EXPECT_TRUE(diagnosis.remaining.structure);
}

TEST(Diagnose, WhatIsLeftOverGetsNoNameForBeingSignificant) {
  // Dry friction, and quick forces that go along with the state without being any effect.
  const Diagnosis diagnosis = diagnosis_of([](double t, double q, double v) {
    return support::dry_friction(t, q, v) + 0.15 * std::sin(25.0 * q) * std::sin(9.0 * t + v);
  });
  EXPECT_EQ(diagnosis.verdict, Verdict::PartlyExplained);
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects[0].name, "dry");
  EXPECT_NEAR(diagnosis.augmented.coefficient(1, "sign(v)"), -0.3, 0.03);
  EXPECT_TRUE(diagnosis.remaining.structure);
  ASSERT_TRUE(diagnosis.gap.has_value());
  EXPECT_LT(diagnosis.gap->ratio(), 0.5);
}

/// A record with its values on a lattice; 0: as they are.
Dataset rounded(Dataset data, double lattice) {
  if (lattice > 0.0)
    for (double& value : data.trajectories.front().states.reshaped())
      value = lattice * std::round(value / lattice);
  return data;
}

/// The diagnosis of dry friction, gauged on records in which something else is hidden.
Diagnosis gauged_on(const support::Hidden& other, double noise = 0.01, double lattice = 0.0) {
  DiagnosisOptions options;
  options.effects = support::own_effects();
  return diagnose(support::oscillator(),
                  rounded(support::hidden_record(support::dry_friction, noise, 3), lattice),
                  rounded(support::hidden_record(other, noise, 4, -0.7), lattice), options,
                  RunContext{});
}

TEST(Diagnose, NamesThatOtherRecordsRefuteAreWithdrawn) {
  const Diagnosis diagnosis = gauged_on(support::nothing);
  EXPECT_EQ(diagnosis.verdict, Verdict::UnnamedStructure);
  EXPECT_TRUE(diagnosis.effects.empty());
  EXPECT_EQ(diagnosis.augmented.coefficient(1, "sign(v)"), 0.0);
  ASSERT_FALSE(diagnosis.notes.empty());
  EXPECT_EQ(diagnosis.notes.back().substr(0, 13), "with dry in v");
}

double friction_and_more(double t, double q, double v) {
  return support::dry_friction(t, q, v) + 1.5 * std::sin(6.0 * q);
}

TEST(Diagnose, NamesThatCloseLittleOfOtherRecordsAreWithdrawn) {
  const Diagnosis diagnosis = gauged_on(friction_and_more);
  EXPECT_EQ(diagnosis.verdict, Verdict::UnnamedStructure);
  EXPECT_TRUE(diagnosis.effects.empty());
  EXPECT_TRUE(diagnosis.remaining.structure);
}

TEST(Diagnose, SamplesThatRepeatNeedOtherRecordsToShowAName) {
  const Diagnosis right = gauged_on(support::dry_friction, 0.0, 0.1);
  ASSERT_EQ(right.effects.size(), 1u);
  EXPECT_EQ(right.effects[0].name, "dry");
  const Diagnosis hardly = gauged_on(friction_and_more, 0.0, 0.1);
  EXPECT_TRUE(hardly.effects.empty());
  ASSERT_FALSE(hardly.notes.empty());
  EXPECT_NE(hardly.notes.back().find("coarse quantisation"), std::string::npos);
}

/// The diagnosis of records whose sensor of v has an offset, a gain and a drift.
Diagnosis with_sensor(double offset, double gain, double drift) {
  const auto measured = [&](std::uint64_t seed, double start) {
    Dataset data = support::hidden_record(support::nothing, 0.005, seed, start);
    Trajectory& record = data.trajectories.front();
    auto v = record.states.col(1).array();
    v = offset + gain * v + drift * record.time.array();
    return data;
  };
  DiagnosisOptions options;
  options.effects = {FamilyEffect<kConstantOffset>{}};
  return diagnose(support::oscillator(), measured(3, 0.5), measured(4, -0.7), options,
                  RunContext{});
}

void expect_sensor(const Diagnosis& diagnosis, const std::string& name, double coefficient) {
  EXPECT_EQ(diagnosis.verdict, Verdict::Explained);
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects[0].name, name);
  EXPECT_EQ(diagnosis.effects[0].equation, 1);
  EXPECT_NEAR(diagnosis.effects[0].coefficient, coefficient, 0.005);
  ASSERT_TRUE(diagnosis.gap.has_value());
  EXPECT_LT(diagnosis.gap->after, 1.1 * diagnosis.gap->noise_floor);
}

TEST(Diagnose, AFaultOfASensorIsNoOtherModel) {
  expect_sensor(with_sensor(0.1, 1.0, 0.0), "sensor-offset", 0.1);
  expect_sensor(with_sensor(0.0, 1.05, 0.0), "sensor-gain", 0.05);
  expect_sensor(with_sensor(0.0, 1.0, 0.02), "sensor-drift", 0.02);
}

/// A complete model, v clipped at both ends and every fifth sample of q blank.
Dataset as_a_bench_records_it(std::uint64_t seed, double start) {
  Dataset data = support::hidden_record(support::nothing, 0.005, seed, start);
  Trajectory& record = data.trajectories.front();
  auto v = record.states.col(1).array();
  v = v.max(-0.7).min(0.5);
  for (Index i = 0; i < record.samples(); i += 5) {
    record.states(i, 0) = 100.0;
    set_mark(record, i, 0, Mark::Missing);
  }
  return data;
}

TEST(Diagnose, HowAChannelWasMeasuredIsNoFaultOfTheModel) {
  DiagnosisOptions options;
  options.effects = {FamilyEffect<kConstantOffset>{}, FamilyEffect<kSaturation>{}};
  const Diagnosis diagnosis = diagnose(support::oscillator(), as_a_bench_records_it(3, 0.5),
                                       as_a_bench_records_it(4, -0.7), options, RunContext{});
  EXPECT_EQ(diagnosis.verdict, Verdict::NoDiscrepancy);
  ASSERT_EQ(diagnosis.notes.size(), 2u);
  EXPECT_NE(diagnosis.notes[0].find("dropouts: 20 % of the samples of q"), std::string::npos);
  EXPECT_NE(diagnosis.notes[1].find("v is clipped at 0.5"), std::string::npos);
  ASSERT_TRUE(diagnosis.gap.has_value());
  EXPECT_LT(diagnosis.gap->before, 1.2 * diagnosis.gap->noise_floor);
}

TEST(Diagnose, WithoutOtherRecordsTheLastQuarterIsKeptBack) {
  DiagnosisOptions options;
  options.effects = support::own_effects();
  const Diagnosis diagnosis =
      diagnose(support::oscillator(), support::hidden_record(support::dry_friction, 0.01), {},
               options, RunContext{});
  ASSERT_TRUE(diagnosis.gap.has_value());
  EXPECT_EQ(diagnosis.gap->records, std::vector<std::string>{"made, last quarter"});
}

TEST(Diagnose, PolynomialsFillWhatNamedEffectsLeaveWhenAsked) {
  const auto hidden = [](double, double q, double v) {
    return -0.4 * (v > 0.0 ? 1.0 : -1.0) + 0.15 * q * v;
  };
  const auto diagnosis_with = [&](bool fill) {
    DiagnosisOptions options;
    options.effects = support::own_effects();
    options.fill_gap = fill;
    return diagnose(support::oscillator(), support::hidden_record(hidden, 0.002, 3),
                    support::hidden_record(hidden, 0.002, 4, -0.7), options, RunContext{});
  };
  const Diagnosis plain = diagnosis_with(false), filled = diagnosis_with(true);
  for (const Diagnosis* diagnosis : {&plain, &filled}) {
    EXPECT_EQ(diagnosis->verdict, Verdict::PartlyExplained);
    ASSERT_EQ(diagnosis->effects.size(), 1u);
    EXPECT_EQ(diagnosis->effects[0].name, "dry");
  }
  EXPECT_EQ(plain.augmented.coefficient(1, "q*v"), 0.0);
  EXPECT_NEAR(filled.augmented.coefficient(1, "q*v"), 0.15, 0.02);
  EXPECT_LT(filled.gap->after, 0.7 * plain.gap->after);
  EXPECT_LT(filled.gap->after, 1.2 * filled.gap->noise_floor);
}

/// A record in pieces of 15 samples, with two missing between them.
Dataset in_pieces(Dataset whole) {
  const Trajectory record = std::exchange(whole.trajectories, {}).front();
  for (Index first = 0; first + 15 <= record.samples(); first += 17)
    whole.trajectories.push_back(
        {"made, piece " + std::to_string(whole.trajectories.size() + 1),
         record.time.segment(first, 15),
         record.states.middleRows(first, 15),
         record.inputs.middleRows(first, 15),
         {}});
  return whole;
}

TEST(Diagnose, ShortGapsAreBridged) {
  const Dataset cut = in_pieces(support::hidden_record(support::dry_friction, 0.01));
  const Dataset other = in_pieces(support::hidden_record(support::dry_friction, 0.01, 4));
  DiagnosisOptions options;
  options.effects = support::own_effects();
  const Diagnosis diagnosis =
      diagnose(support::oscillator(), cut, other, options, RunContext{});
  EXPECT_EQ(diagnosis.verdict, Verdict::Explained);
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_NEAR(diagnosis.effects[0].coefficient, -0.3, 0.02);
  EXPECT_EQ(diagnosis.gap->records, std::vector<std::string>{"made"});
  ASSERT_FALSE(diagnosis.notes.empty());
  EXPECT_EQ(diagnosis.notes[0], "87 short gaps in the records are bridged");
}

TEST(Diagnose, PiecesThatAreTooShortAreAnErrorThatSaysSo) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  Trajectory& record = data.trajectories.front();
  record = {"short.csv",
            record.time.head(12),
            record.states.topRows(12),
            record.inputs.topRows(12),
            {}};
  try {
    diagnose(support::oscillator(), data, {}, {}, RunContext{});
    FAIL() << "twelve samples are too few";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("short.csv: no record has 20 samples"),
              std::string::npos)
        << error.what();
  }
}

TEST(Diagnose, AModelThatDivergesWithinAStepIsAnErrorThatNamesUnits) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories.front().time *= 1e8;
  DiagnosisOptions options;
  options.decision.hints.slip_remainder = 0.0;  // not looked for
  options.decision.hints.identity_factor = 1e12;
  EXPECT_THROW(diagnose(support::runaway(), data, {}, options, RunContext{}), DataError);
}

/// The record with a column G that acts on dv/dt.
Dataset with_column_acting() {
  Dataset data = support::hidden_record(
      [](double t, double, double) { return 0.6 * std::sin(2.3 * t); }, 0.005);
  data.inputs.push_back({"G", ""});
  Trajectory& record = data.trajectories.front();
  record.inputs.conservativeResize(record.samples(), 2);
  record.inputs.col(1) = (2.3 * record.time.array()).sin() + 0.3 * record.time.array().sin();
  return data;
}

TEST(Diagnose, AColumnTheModelDoesNotKnowComesBeforeAName) {
  const Diagnosis diagnosis = diagnose(support::oscillator(), with_column_acting(), {},
                                       {.effects = support::own_effects()}, RunContext{});
  EXPECT_EQ(diagnosis.verdict, Verdict::UnnamedStructure);
  EXPECT_TRUE(diagnosis.effects.empty());
  ASSERT_EQ(diagnosis.hints.size(), 1u);
  EXPECT_EQ(diagnosis.hints[0].kind, HintKind::UnusedColumn);
  EXPECT_TRUE(diagnosis.gap.has_value());
  ASSERT_EQ(diagnosis.disagreement.size(), 1u);
  EXPECT_GT(diagnosis.disagreement[0].sigma, 5.0);
}

TEST(Diagnose, ASlipIsAllOfTheAnswer) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories.front().time *= 1e8;
  const Diagnosis diagnosis = diagnose(support::oscillator(), data, {},
                                       {.effects = support::own_effects()}, RunContext{});
  EXPECT_EQ(diagnosis.verdict, Verdict::UnnamedStructure);
  ASSERT_EQ(diagnosis.hints.size(), 1u);
  EXPECT_EQ(diagnosis.hints[0].kind, HintKind::TimeUnit);
  EXPECT_TRUE(diagnosis.remaining.structure);
  EXPECT_TRUE(diagnosis.rivals.empty()) << "nothing was sought";
}

TEST(Diagnose, AnInputWithTheOtherSignIsFittedAndNotNamed) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories.front().inputs *= -1.0;
  const Diagnosis diagnosis = diagnose(support::oscillator(), data, {},
                                       {.effects = support::own_effects()}, RunContext{});
  EXPECT_EQ(diagnosis.verdict, Verdict::CoefficientsOnly);
  ASSERT_EQ(diagnosis.hints.size(), 1u);
  EXPECT_EQ(diagnosis.hints[0].kind, HintKind::Sign);
  EXPECT_EQ(diagnosis.coefficient_changes[0].term, "F");
  EXPECT_NEAR(diagnosis.coefficient_changes[0].estimated, -1.0, 0.02);
}

/// A random function of time: straight lines between values half a second apart.
double gusts(double t, double, double) {
  static const std::vector<double> values = [] {
    Random random(5);
    std::vector<double> drawn(70);
    for (double& value : drawn) value = random.normal();
    return drawn;
  }();
  const auto before = static_cast<std::size_t>(2.0 * t);
  const double fraction = 2.0 * t - static_cast<double>(before);
  return (1.0 - fraction) * values[before] + fraction * values[before + 1];
}

Diagnosis with_free_input(const support::Hidden& hidden, bool fill) {
  DiagnosisOptions options;
  options.effects = {FamilyEffect<kUnmeasuredInput>{}};
  options.fill_gap = fill;
  return diagnose(support::oscillator(), support::hidden_record(hidden, 0.005, 3),
                  support::hidden_record(hidden, 0.005, 4, -0.7), options, RunContext{});
}

TEST(Diagnose, AnInputThatWasNotMeasuredHasAName) {
  const Diagnosis diagnosis = with_free_input(gusts, false);
  EXPECT_EQ(diagnosis.verdict, Verdict::PartlyExplained) << "the gap stays";
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects[0].name, "unmeasured-input");
  EXPECT_EQ(diagnosis.effects[0].coefficient, 1.0);
}

TEST(Diagnose, AFunctionOfAStateIsNoInput) {
  const auto ripple = [](double, double q, double) { return 1.5 * std::sin(6.0 * q); };
  const Diagnosis diagnosis = with_free_input(ripple, true);
  EXPECT_EQ(diagnosis.verdict, Verdict::UnnamedStructure);
  EXPECT_TRUE(diagnosis.effects.empty());
  ASSERT_TRUE(diagnosis.unnamed.has_value());
  EXPECT_EQ(diagnosis.unnamed->variables, std::vector<std::string>{"q"});
  EXPECT_FALSE(diagnosis.unnamed->memory);
  EXPECT_TRUE(diagnosis.unnamed->filled);
  EXPECT_GT(diagnosis.unnamed->explained, 0.9);
  EXPECT_LT(diagnosis.gap->ratio(), 0.3) << "the spline stands in the model";
}

TEST(Diagnose, RecordsThatLackAnInputOrAllStatesAreAnError) {
  const Dataset whole = support::hidden_record(support::nothing, 0.01);
  Dataset deaf = whole, foreign = whole;
  deaf.inputs.clear();
  deaf.trajectories[0].inputs.resize(whole.samples(), 0);
  foreign.states = {{"one", ""}, {"two", ""}};
  for (const Dataset& lacking : {deaf, foreign}) {
    EXPECT_THROW(diagnose(support::oscillator(), lacking), DataError);
    EXPECT_THROW(diagnose(support::oscillator(), whole, lacking), DataError);
  }
}

TEST(Diagnose, AStateWithoutAColumnIsMadeAsTheModelDefinesIt) {
  Dataset lacking = support::hidden_record(support::nothing, 0.01);
  lacking.states.pop_back();
  lacking.trajectories[0].states.conservativeResize(Eigen::NoChange, 1);
  const OdeModel model = support::oscillator();
  const Diagnosis made = diagnose(model, lacking, {}, {.effects = {}});
  const Diagnosis viewed =
      diagnose(model, model_view(model, lacking, FiniteDifferences{}), {}, {.effects = {}});
  EXPECT_EQ(made.verdict, viewed.verdict);
  ASSERT_TRUE(made.gap.has_value() && viewed.gap.has_value());
  EXPECT_EQ(made.gap->after, viewed.gap->after);
}

TEST(Diagnose, WhereStatesAreHiddenWhiteNoiseTellsNothingEither) {
  const OdeModel model = parse_ode("dx/dt = -x + z\ndz/dt = -2*z - x", "m");
  Dataset noise;
  noise.states = {{"x", ""}};
  Random random(8);
  const Vector time = Vector::LinSpaced(600, 0.0, 30.0);
  const Matrix x = Matrix::NullaryExpr(600, 1, [&] { return 0.01 * random.normal(); });
  noise.trajectories = {{"noise.csv", time, x, Matrix(600, 0), {}}};
  const Dataset view = model_view(model, noise, FiniteDifferences{});
  const Diagnosis diagnosis = diagnose(model, view, {}, {}, RunContext{});
  ASSERT_FALSE(diagnosis.hints.empty());
  EXPECT_EQ(diagnosis.hints[0].kind, HintKind::Excitation);
  EXPECT_EQ(diagnosis.hints[0].withheld, Withheld::Claims);
  EXPECT_TRUE(diagnosis.effects.empty());
  EXPECT_TRUE(diagnosis.coefficient_changes.empty());
}

TEST(Diagnose, RecordsInWhichNothingEverChangesAreAnError) {
  Dataset still = support::hidden_record(support::nothing, 0.0);
  still.trajectories[0].states.col(0).setConstant(0.5);
  still.trajectories[0].states.col(1).setZero();
  try {
    diagnose(support::oscillator(), still, {}, {}, RunContext{});
    FAIL() << "nothing moves";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("nothing moves"), std::string::npos);
  }
}

}  // namespace
}  // namespace lacuna
