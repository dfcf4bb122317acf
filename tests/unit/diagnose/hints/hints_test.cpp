// SPDX-License-Identifier: MIT
// What records say of units, signs and motions before anything is searched.
#include "diagnose/hints/hints.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "diagnose/hints/motion_hints.hpp"
#include "diagnose/hints/unit_hints.hpp"
#include "diagnose/hints/unused_columns.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "support/diagnosis_scope.hpp"
#include "support/driven_oscillator.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

const OdeModel kOscillator = support::oscillator();

std::vector<Hint> hints_of(const OdeModel& model, const Dataset& data) {
  return look_at(model, observed(used_part(model, data)), unused_part(model, data), {});
}

TEST(LookAt, SaysNothingOfAHealthyRecord) {
  EXPECT_TRUE(hints_of(kOscillator, support::hidden_record(support::nothing, 0.01)).empty());
  EXPECT_EQ(withheld_by({}), Withheld::Nothing);
}

TEST(LookAt, ColumnsTheModelDoesNotKnowAreTried) {
  const OdeModel without({{"q", "m"}, {"v", "m/s"}}, {},
                         {kOscillator.equations()[0],
                          {kOscillator.equations()[1][0], kOscillator.equations()[1][1]}});
  const std::vector<Hint> hints =
      hints_of(without, support::hidden_record(support::nothing, 0.01));
  ASSERT_EQ(hints.size(), 1u);
  EXPECT_EQ(to_string(hints[0].kind), "unused-column");
  EXPECT_THAT(hints[0].message, ::testing::HasSubstr("column F"));
  EXPECT_EQ(withheld_by(hints), Withheld::Names);
}

TEST(LookAt, LeavesModelsWithDelaysAlone) {
  const OdeModel late =
      kOscillator.with_term(1, {Term::parse("delay(q,0.1)", kOscillator.variables()), -1.0});
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories[0].time *= 1000.0;
  EXPECT_TRUE(hints_of(late, data).empty());
}

/// The hint that a coefficient of dv/dt of the driven oscillator gives.
std::optional<Hint> hint_for(const std::string& term, double ratio, double deviation = 1e-3) {
  return coefficient_hint(support::oscillator(), support::oscillator_record(),
                          {1, term, ratio, deviation}, {});
}

TEST(CoefficientHint, TellsTheUnitOrSignOfAnInput) {
  const auto unit = hint_for("F", 0.0998);
  ASSERT_TRUE(unit);
  EXPECT_EQ(unit->kind, HintKind::ChannelUnit);
  EXPECT_THAT(unit->message, ::testing::HasSubstr("F looks 10 times too large"));
  EXPECT_EQ(unit->withheld, Withheld::Nothing);
  const auto sign = hint_for("F", -1.02);
  ASSERT_TRUE(sign);
  EXPECT_EQ(sign->kind, HintKind::Sign);
}

TEST(CoefficientHint, SaysNothingOfOtherNumbers) {
  EXPECT_FALSE(hint_for("F", 1.0));
  EXPECT_FALSE(hint_for("F", 8.5));
  EXPECT_FALSE(hint_for("F", -0.8));
  EXPECT_FALSE(hint_for("F", 10.0, 2.0)) << "not known well enough";
  EXPECT_FALSE(hint_for("q", 1000.0)) << "the unit of q would change the identity too";
  EXPECT_FALSE(hint_for("v", -1.0));
}

/// What all coefficients of the driven oscillator, dq/dt = v and dv/dt in q, v and F, say of
/// time.
std::optional<Hint> clock_hint_for(double q, double v, double force, bool measured = false) {
  Dataset data = support::oscillator_record();
  if (!measured) data.reconstructed = {false, true};
  return clock_hint(support::oscillator(), data,
                    {{1, "q", q, 1e-3}, {1, "v", v, 1e-3}, {1, "F", force, 1e-3}}, {});
}

TEST(ClockHint, FollowsThePowersOfTimeInEachCoefficient) {
  // v is made of q: in a time that is 3 times too long it is a third, and its rate a ninth.
  const auto hint = clock_hint_for(1.0 / 9.0, 1.0 / 3.0, 1.0 / 9.0);
  ASSERT_TRUE(hint);
  EXPECT_EQ(hint->kind, HintKind::TimeUnit);
  EXPECT_THAT(hint->message, ::testing::HasSubstr("all rates are 3 times too small"));
  EXPECT_EQ(hint->withheld, Withheld::Nothing);
}

TEST(ClockHint, NeedsAllCoefficientsAndAFactorThatIsNoUnit) {
  EXPECT_FALSE(clock_hint_for(1.0 / 9.0, 1.0 / 3.0, 1.0 / 5.0));
  EXPECT_FALSE(clock_hint_for(1.0 / 9.0, 1.0 / 3.0, -1.0 / 9.0));
  EXPECT_FALSE(clock_hint_for(1.2 * 1.2, 1.2, 1.2 * 1.2)) << "may be a mass";
  EXPECT_FALSE(clock_hint_for(1.0 / 9.0, 1.0 / 3.0, 1.0 / 9.0, true)) << "dq/dt = v holds";
}

const OdeModel kInUnits = support::oscillator();  // q, v; F

/// Hints for the input in counts, of which one is so many of the model's unit.
std::vector<Hint> hints_for_counts(double size) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.inputs[0].unit = "counts";
  data.trajectories[0].inputs /= size;
  const BoundRecords records = observed(data);
  return unit_hints(kInUnits, records, rate_windows(records), {});
}

TEST(UnitHints, TheRecordsSuggestTheFactor) {
  ASSERT_FALSE(kInUnits.inputs()[0].unit.empty());
  const std::vector<Hint> hints = hints_for_counts(0.00307);
  ASSERT_EQ(hints.size(), 1u);
  EXPECT_THAT(hints[0].message, HasSubstr("F is in counts in the records"));
  EXPECT_THAT(hints[0].message, HasSubstr("1 counts is 0.003"));
  EXPECT_EQ(hints[0].withheld, Withheld::Answer);
}

TEST(UnitHints, WhereNothingIsOffItIsARemark) {
  const std::vector<Hint> hints = hints_for_counts(1.0);
  ASSERT_EQ(hints.size(), 1u);
  EXPECT_THAT(hints[0].message, HasSubstr("F (counts for N); values are taken as "
                                          "they are, and show no factor"));
  EXPECT_EQ(hints[0].withheld, Withheld::Nothing);
}

TEST(UnitHints, KnownUnitsHaveNone) {
  const BoundRecords records = observed(support::hidden_record(support::nothing, 0.01));
  EXPECT_TRUE(unit_hints(kInUnits, records, rate_windows(records), {}).empty());
}

TEST(UnitHints, ColumnsInEachOthersUnitsLookSwapped) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  ASSERT_EQ(kInUnits.states()[0].unit, "m");
  data.states[0].unit = "km/h";
  data.states[1].unit = "cm";
  const BoundRecords records = observed(data);
  const std::vector<Hint> hints = unit_hints(kInUnits, records, rate_windows(records), {});
  ASSERT_EQ(hints.size(), 1u);
  EXPECT_EQ(hints[0].kind, HintKind::SwappedColumns);
  EXPECT_EQ(hints[0].withheld, Withheld::Answer);
  EXPECT_THAT(hints[0].message, HasSubstr("q is in km/h and in m in the model, v is in cm"));
  EXPECT_THAT(hints[0].remedy, HasSubstr("exchange the names of the columns q and v"));
}

/// The records with one further column, a function of a sample, as their only input.
template <class Column>
Dataset with_column(Dataset data, const Column& column) {
  data.inputs = {{"G", ""}};
  Trajectory& record = data.trajectories[0];
  for (Index i = 0; i < record.samples(); ++i) record.inputs(i, 0) = column(record, i);
  return data;
}

template <class Column>
std::vector<Hint> hints_for(const support::Hidden& hidden, const Column& column) {
  const Dataset data = support::hidden_record(hidden, 0.01);
  const BoundRecords records = observed(data);
  return unused_column_hints(support::oscillator(), records, with_column(data, column),
                             rate_windows(records), {});
}

TEST(UnusedColumns, SayNothingOfCopiesOfWhatTheModelKnows) {
  const auto cubic = [](double, double q, double) { return -0.6 * q * q * q; };
  Random random(5);
  EXPECT_TRUE(
      hints_for(cubic, [&](const Trajectory& record,
                           Index i) { return record.states(i, 0) + 1e-3 * random.normal(); })
          .empty())
      << "q again";
  EXPECT_TRUE(hints_for(cubic,
                        [](const Trajectory& record, Index i) {
                          const double q = record.states(i, 0), v = record.states(i, 1);
                          return -4.0 * q - 0.2 * v - 0.6 * q * q * q + record.inputs(i, 0);
                        })
                  .empty())
      << "the acceleration";
  EXPECT_TRUE(
      hints_for(cubic, [](const Trajectory& record, Index i) { return 7.0 * record.time[i]; })
          .empty())
      << "another clock";
}

std::vector<HintKind> kinds_of(const Dataset& data) {
  const BoundRecords records = observed(data);
  std::vector<HintKind> kinds;
  for (const Hint& hint :
       motion_hints(support::oscillator(), records, rate_windows(records), {})) {
    kinds.push_back(hint.kind);
    EXPECT_EQ(hint.withheld, Withheld::Nothing);
  }
  return kinds;
}

Dataset good() { return support::hidden_record(support::nothing, 0.01); }

TEST(MotionHints, TellAnInputThatFollowsTheStates) {
  Dataset data = good();
  Trajectory& record = data.trajectories[0];
  record.inputs =
      -0.5 * record.states.col(0) - 0.3 * record.states.col(1) + 0.1 * record.inputs;
  EXPECT_THAT(kinds_of(data), ::testing::ElementsAre(HintKind::ClosedLoop));
  record.inputs = -0.5 * record.states.col(0) - 0.3 * record.states.col(1);
  EXPECT_THAT(kinds_of(data),
              ::testing::ElementsAre(HintKind::ClosedLoop, HintKind::NotIdentifiable));
}

TEST(MotionHints, StatesThatFollowAnInputAreNoFeedback) {
  Dataset data = good();
  Trajectory& record = data.trajectories[0];
  Random random(5);
  double level = 0.0;
  for (Index i = 0; i < record.samples(); ++i) {
    record.states(i, 0) = 0.5 * level + 0.01 * random.normal();  // of the step before
    record.states(i, 1) = -level + 0.01 * random.normal();
    if (i % 40 == 0) level = random.normal();
    record.inputs(i, 0) = level;
  }
  EXPECT_THAT(kinds_of(data), ::testing::Not(::testing::Contains(HintKind::ClosedLoop)));
  for (Index i = 1; i < record.samples(); ++i)
    record.inputs(i, 0) = -record.states(i, 1) + 0.01 * random.normal();
  EXPECT_THAT(kinds_of(data), ::testing::Contains(HintKind::ClosedLoop));
}

TEST(MotionHints, TellWhatDoesNotMove) {
  Dataset data = good();
  data.trajectories[0].inputs.setConstant(0.7);
  EXPECT_THAT(kinds_of(data), ::testing::ElementsAre(HintKind::Excitation));
  data = good();
  Random random(4);
  for (double& q : data.trajectories[0].states.col(0)) q = 1e-3 * random.normal();
  EXPECT_THAT(kinds_of(data), ::testing::Contains(HintKind::Excitation));
}

std::vector<Hint> hints_of(const Dataset& data) {
  const BoundRecords records = observed(data);
  return motion_hints(support::oscillator(), records, rate_windows(records), {});
}

TEST(MotionHints, WhiteNoiseTellsNothing) {
  Random random(8);
  Dataset still = good();
  Trajectory& record = still.trajectories[0];
  for (double& value : record.states.reshaped()) value = 1.0 + 0.01 * random.normal();
  const std::vector<Hint> hints = hints_of(still);
  EXPECT_EQ(withheld_by(hints), Withheld::Claims);
  EXPECT_THAT(hints.back().message, HasSubstr("nothing moves"));
  // A channel that never changes says no more.
  still.trajectories[0].states.col(1).setConstant(3.0);
  EXPECT_EQ(withheld_by(hints_of(still)), Withheld::Claims);
  // A motion of half the noise in one state is something.
  for (Index i = 0; i < record.samples(); ++i)
    record.states(i, 0) += 0.007 * std::sin(2.0 * record.time[i]);
  EXPECT_EQ(withheld_by(hints_of(still)), Withheld::Nothing);
}

TEST(MotionHints, TellFewSamplesAndFewPeriods) {
  const Dataset data = good();
  const Trajectory& record = data.trajectories[0];
  Dataset coarse = data;
  const auto every = Eigen::seqN(0, 50, 30);  // 0.6 s of periods of 3 s
  coarse.trajectories = {{"r", record.time(every), record.states(every, Eigen::all),
                          record.inputs(every, Eigen::all), Matrix()}};
  EXPECT_THAT(kinds_of(coarse), ::testing::Contains(HintKind::Sampling));
  Dataset brief = data;
  brief.trajectories = {rows_of(record, 0, 200)};
  EXPECT_THAT(kinds_of(brief), ::testing::Contains(HintKind::Sampling));
}

TEST(MotionHints, OneWayToARestTellsNoStructure) {
  Dataset data = good();
  data.trajectories = {rows_of(data.trajectories[0], 0, 200)};
  EXPECT_EQ(withheld_by(hints_of(data)), Withheld::Nothing) << "the input moves";
  data.trajectories[0].inputs.setConstant(0.7);
  const std::vector<Hint> hints = hints_of(data);
  EXPECT_EQ(withheld_by(hints), Withheld::Names);
  data = good();
  data.trajectories[0].inputs.setConstant(0.7);
  EXPECT_EQ(withheld_by(hints_of(data)), Withheld::Nothing) << "many periods";
}

/// An armature, L di/dt = u - R i - K w with L/R of 2 ms, and what it turns, under a slow sine.
Dataset armature_record() {
  constexpr double kStep = 0.01;
  constexpr int kParts = 100;
  Trajectory record{"armature",
                    Vector::LinSpaced(1000, 0.0, 999 * kStep),
                    Matrix(1000, 2),
                    Matrix(1000, 1),
                    {}};
  Random random(6);
  double w = 0.0, i = 0.0;
  const auto voltage = [](double t) { return 2.0 * std::sin(0.9 * t); };
  for (Index n = 0; n < 1000; ++n) {
    const double t = record.time[n];
    record.states.row(n) << w + 1e-3 * random.normal(), i + 1e-3 * random.normal();
    record.inputs(n, 0) = voltage(t);
    for (int part = 0; part < kParts; ++part) {
      const double h = kStep / kParts, u = voltage(t + h * part);
      i += h * (500.0 * u - 500.0 * i - 250.0 * w);
      w += h * (4.0 * i - w);
    }
  }
  return support::one_record({{"w", "rad/s"}, {"i", "A"}}, {{"u", "V"}}, std::move(record));
}

TEST(MotionHints, WhatThePlantMakesOfAnInputIsNoFeedback) {
  const BoundRecords open = observed(armature_record());
  const auto kinds = [&](const std::string& current) {
    std::vector<HintKind> found;
    const OdeModel model = parse_ode(
        "input u [V]\nstate w [rad/s]\nstate i [A]\ndw/dt = 4*i - w\ndi/dt = " + current, "m");
    for (const Hint& hint : motion_hints(model, open, rate_windows(open), {}))
      found.push_back(hint.kind);
    return found;
  };
  EXPECT_THAT(kinds("500*u - 500*i - 250*w"),
              ::testing::Not(::testing::Contains(HintKind::ClosedLoop)));
  // Were it not this equation that makes up for u, it would be feedback.
  EXPECT_THAT(kinds("0.01*u - 500*i - 250*w"), ::testing::Contains(HintKind::ClosedLoop));
}

}  // namespace
}  // namespace lacuna
