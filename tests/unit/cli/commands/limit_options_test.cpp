// SPDX-License-Identifier: MIT
#include "cli/commands/limit_options.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna::cli {
namespace {

Dataset two_channels() {
  Dataset data;
  data.states = {{"q", "V"}, {"v", ""}};
  Trajectory record;
  record.time = Vector{{0.0, 1.0, 2.0}};
  record.states = Matrix{{-6.0, 9.0}, {0.0, 9.0}, {5.0, 9.0}};
  data.trajectories = {std::move(record)};
  return data;
}

TEST(WithGivenLimits, MarksWhatLiesThereOrBeyond) {
  const Dataset data = with_given_limits(two_channels(), {"q=-5:5"});
  const Trajectory& record = data.trajectories[0];
  EXPECT_EQ(mark_of(record.marks, 0, 0), Mark::AtBottom);
  EXPECT_EQ(record.states(0, 0), -5.0);
  EXPECT_EQ(mark_of(record.marks, 2, 0), Mark::AtTop);
  EXPECT_EQ(mark_of(record.marks, 2, 1), Mark::Value) << "no limits were given";
}

TEST(WithGivenLimits, AnEndMayBeMissing) {
  const Dataset data = with_given_limits(two_channels(), {"q=:5", "v=8:"});
  EXPECT_EQ(mark_of(data.trajectories[0].marks, 0, 0), Mark::Value);
  EXPECT_EQ(mark_of(data.trajectories[0].marks, 2, 0), Mark::AtTop);
  EXPECT_EQ(with_given_limits(two_channels(), {}).trajectories[0].marks.size(), 0);
}

TEST(WithGivenLimits, SaysWhatIsNotARange) {
  for (const char* text : {"q", "q=5", "q=a:5", "q=5:-5", "z=1:2"})
    EXPECT_THROW(with_given_limits(two_channels(), {text}), ConfigError) << text;
}

}  // namespace
}  // namespace lacuna::cli
