// SPDX-License-Identifier: MIT
#include "data/records/state_statistics.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(StateStatistics, AreThoseOfAllRecordsTogetherAndASpanIsNever0) {
  Dataset data{.states = {{"x", ""}}, .inputs = {}, .trajectories = {}, .rate_of = {}};
  for (const double first : {0.0, 4.0})
    data.trajectories.push_back(
        {"made", Vector{{0.0, 1.0}}, Matrix{{first}, {first + 2.0}}, Matrix(2, 0), Matrix()});
  EXPECT_DOUBLE_EQ(state_variance(data, 0), 5.0);
  EXPECT_DOUBLE_EQ(state_spans(data)[0], 6.0);
  for (Trajectory& record : data.trajectories) record.states.setOnes();
  EXPECT_GT(state_spans(data)[0], 0.0);
}

}  // namespace
}  // namespace lacuna
