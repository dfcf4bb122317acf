// SPDX-License-Identifier: MIT
#include "lacuna/records/unused_part.hpp"

#include <gtest/gtest.h>

#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

TEST(UnusedPart, IsWhatFollowsTheInputsOfTheModel) {
  Dataset data = support::oscillator_record();
  Trajectory& record = data.trajectories[0];
  data.inputs.push_back({"G", "N"});
  record.inputs.conservativeResize(record.samples(), 2);
  record.inputs.col(1) = 3.0 * record.time;
  const Dataset used = used_part(support::oscillator(), data);
  const Dataset unused = unused_part(support::oscillator(), data);
  EXPECT_EQ(used.inputs, support::oscillator().inputs());
  EXPECT_EQ(used.trajectories[0].inputs, record.inputs.leftCols(1));
  ASSERT_EQ(unused.inputs.size(), 1u);
  EXPECT_EQ(unused.inputs[0].name, "G");
  EXPECT_EQ(unused.trajectories[0].inputs, 3.0 * record.time);
}

TEST(UnusedPart, IsEmptyWhereTheModelKnowsAll) {
  const Dataset data = support::oscillator_record();
  EXPECT_EQ(used_part(support::oscillator(), data).trajectories[0].inputs,
            data.trajectories[0].inputs);
  EXPECT_EQ(unused_part(support::oscillator(), data).trajectories[0].inputs.cols(), 0);
}

}  // namespace
}  // namespace lacuna
