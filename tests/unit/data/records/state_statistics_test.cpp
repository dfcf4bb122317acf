// SPDX-License-Identifier: MIT
#include "data/records/state_statistics.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

/// Two records of one state: 0, 2 and 4, 6.
Dataset two_records() {
  Dataset data{.states = {{"x", ""}}, .inputs = {}, .trajectories = {}, .rate_of = {}};
  for (const double first : {0.0, 4.0})
    data.trajectories.push_back(
        {"made", Vector{{0.0, 1.0}}, Matrix{{first}, {first + 2.0}}, Matrix(2, 0), Matrix()});
  return data;
}

TEST(StateStatistics, AreThoseOfAllRecordsTogether) {
  EXPECT_DOUBLE_EQ(state_variance(two_records(), 0), 5.0);
  EXPECT_DOUBLE_EQ(state_spans(two_records())[0], 6.0);
}

TEST(StateStatistics, ASpanIsNever0) {
  Dataset still = two_records();
  for (Trajectory& record : still.trajectories) record.states.setOnes();
  EXPECT_GT(state_spans(still)[0], 0.0);
}

TEST(StateStatistics, OneMarkedSampleIsEnough) {
  Dataset data = two_records();
  EXPECT_FALSE(has_marks(data));
  data.trajectories[1].marks = Matrix::Zero(2, 1);
  EXPECT_TRUE(has_marks(data));
}

}  // namespace
}  // namespace lacuna
