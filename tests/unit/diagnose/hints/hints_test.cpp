// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "diagnose/hints/unit_hints.hpp"
#include "diagnose/hints/unused_columns.hpp"
#include "lacuna/diagnose/hints/hints.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "support/diagnosis_scope.hpp"
#include "support/driven_oscillator.hpp"

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

}  // namespace
}  // namespace lacuna
