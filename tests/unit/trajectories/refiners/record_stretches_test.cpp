// SPDX-License-Identifier: MIT
#include "trajectories/refiners/record_stretches.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

/// Records of so many samples; times and states count on from record to record.
Dataset records_of(const std::vector<Index>& lengths) {
  Dataset data;
  data.states = {{"x", ""}};
  double first = 0.0;
  for (const Index n : lengths) {
    Trajectory record;
    record.time = Vector::LinSpaced(n, first, first + static_cast<double>(n - 1));
    record.states = record.time;
    record.inputs.resize(n, 0);
    data.trajectories.push_back(std::move(record));
    first += 2.0 * static_cast<double>(n);
  }
  return data;
}

TEST(RecordStretches, ShortRecordsStayAsTheyAre) {
  const Dataset part = record_stretches(records_of({900, 1100}), 1000, 10);
  ASSERT_EQ(part.trajectories.size(), 2U);
  EXPECT_EQ(part.samples(), 2000);
}

TEST(RecordStretches, AreEvenlySpread) {
  const Dataset part = record_stretches(records_of({160000}), 1600, 10);
  ASSERT_EQ(part.trajectories.size(), 16U);
  for (Index i = 0; i < 16; ++i) {
    const Trajectory& stretch = part.trajectories[static_cast<std::size_t>(i)];
    EXPECT_EQ(stretch.samples(), 100);
    EXPECT_EQ(stretch.states(0, 0), 10000.0 * (static_cast<double>(i) + 0.5) - 50.0);
    EXPECT_EQ(stretch.time[0], stretch.states(0, 0));
  }
}

TEST(RecordStretches, HoldEightWindows) {
  const Dataset part = record_stretches(records_of({160000}), 1600, 50);
  ASSERT_EQ(part.trajectories.size(), 4U);
  EXPECT_EQ(part.trajectories[0].samples(), 400);
}

TEST(RecordStretches, RecordsHaveTheirFraction) {
  const Dataset part = record_stretches(records_of({30000, 10000, 150}), 1600, 10);
  EXPECT_EQ(part.trajectories.size(), 17U);  // 12, 4, and a short one as it is
  EXPECT_EQ(part.trajectories.back().samples(), 150);
}

}  // namespace
}  // namespace lacuna
