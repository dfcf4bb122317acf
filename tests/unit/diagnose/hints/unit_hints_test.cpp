// SPDX-License-Identifier: MIT
#include "diagnose/hints/unit_hints.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

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

}  // namespace
}  // namespace lacuna
