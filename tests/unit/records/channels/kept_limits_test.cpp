// SPDX-License-Identifier: MIT
#include "records/channels/kept_limits.hpp"

#include <gtest/gtest.h>

#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

TEST(LimitsKeptBy, AnEndThatOtherRecordsGoBeyondIsNone) {
  Dataset other;
  other.states = {{"x", "V"}};
  Trajectory record;
  record.time = Vector::LinSpaced(4, 0.0, 3.0);
  record.states = Eigen::Vector4d(-0.9, 0.0, 0.7, 5.0);
  set_mark(record, 3, 0, Mark::Missing);
  other.trajectories = {record};
  const auto kept = limits_kept_by(other, {{-0.8, 0.7}});
  EXPECT_FALSE(kept[0].low);
  EXPECT_EQ(kept[0].high, 0.7);
}

}  // namespace
}  // namespace lacuna
