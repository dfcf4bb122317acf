// SPDX-License-Identifier: MIT
#include "identify/validation/held_blocks.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

/// Records of so many samples; the one state counts samples through all records.
Dataset counted(const std::vector<Index>& samples) {
  Dataset data;
  data.states = {{"x", ""}};
  double value = 0.0;
  for (const Index n : samples) {
    Trajectory record;
    record.time = Vector::LinSpaced(n, 0.0, static_cast<double>(n - 1));
    record.states = Matrix(n, 1);
    record.inputs = Matrix(n, 0);
    for (Index i = 0; i < n; ++i) record.states(i, 0) = value++;
    data.trajectories.push_back(std::move(record));
  }
  return data;
}

Index samples_in(const std::vector<Block>& blocks) {
  Index total = 0;
  for (const Block& block : blocks) total += block.count;
  return total;
}

TEST(HeldBlocks, AreAQuarterSpreadOverTheRecord) {
  const Dataset data = counted({2000});
  const std::vector<Block> blocks = held_blocks(data, 30);
  EXPECT_EQ(samples_in(blocks), 500);
  ASSERT_EQ(blocks.size(), 5U);
  for (std::size_t b = 1; b < blocks.size(); ++b)
    EXPECT_EQ(blocks[b].first - blocks[b - 1].first, 400);
}

TEST(HeldBlocks, HoldAWindowUnlessThatLeavesFewerThanEight) {
  EXPECT_NEAR(double(held_blocks(counted({2000}), 150).front().count), 2000.0 / 13.0, 1.0);
  EXPECT_EQ(held_blocks(counted({800}), 800).front().count, 100);
}

TEST(HeldBlocks, OfManyShortRecordsEveryFourthIsHeldOut) {
  const std::vector<Block> blocks = held_blocks(counted(std::vector<Index>(40, 25)), 20);
  ASSERT_EQ(blocks.size(), 10U);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    EXPECT_EQ(blocks[b].record, 4 * b + 2);
    EXPECT_EQ(blocks[b].count, 25);
  }
}

/// A record that rests, moves for a while and rests again.
Dataset resting(Index before, Index moving, Index behind) {
  Dataset data = counted({before + moving + behind});
  auto x = data.trajectories[0].states.col(0);
  x.head(before).setConstant(double(before));
  x.tail(behind).setConstant(double(before + moving - 1));
  return data;
}

TEST(HeldBlocks, AreWhereARecordMoves) {
  const std::vector<Block> blocks = held_blocks(resting(3000, 400, 5000), 20);
  ASSERT_NEAR(double(samples_in(blocks)), 100.0, 20.0);
  ASSERT_FALSE(blocks.empty());
  for (const Block& block : blocks) {
    EXPECT_GE(block.first, 2999);
    EXPECT_LE(block.first + block.count, 3402);
  }
}

TEST(HeldBlocks, WithThemTheRestIsTheWholeRecord) {
  const Dataset data = counted({500, 300});
  const std::vector<Block> blocks = held_blocks(data, 20);
  const Dataset rest = without_blocks(data, blocks, 2);
  EXPECT_EQ(rest.samples() + samples_in(blocks), 800);
  double sum = 0.0;
  for (const Trajectory& record : rest.trajectories) sum += record.states.sum();
  for (const Block& block : blocks)
    sum += data.trajectories[block.record].states.middleRows(block.first, block.count).sum();
  EXPECT_EQ(sum, 799.0 * 800.0 / 2.0);
}

TEST(HeldBlocks, ShortStretchesOfTheRestAreDropped) {
  const Dataset data = counted({30});
  const Dataset rest = without_blocks(data, {{0, 5, 10}}, 10);
  ASSERT_EQ(rest.trajectories.size(), 1U);
  EXPECT_EQ(rest.trajectories[0].states(0, 0), 15.0);
  EXPECT_EQ(rest.samples(), 15);
}

}  // namespace
}  // namespace lacuna
