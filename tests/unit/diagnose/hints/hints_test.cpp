// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/hints/hints.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/records/binding/read_records.hpp"
#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
