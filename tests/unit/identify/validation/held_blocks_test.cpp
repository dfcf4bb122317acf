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

TEST(HeldBlocks, TheirNumberAndFractionAreOptions) {
  EXPECT_EQ(held_blocks(counted({2000}), 30, {.held_every = 2}).size(), 10U);
  EXPECT_EQ(held_blocks(counted({2000}), 30, {.blocks = 40}).front().count, 50);
  EXPECT_EQ(held_blocks(counted({800}), 800, {.fewest_blocks = 4}).front().count, 200);
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

TEST(HeldBlocks, NoiseIsMotionAndAConstantRecordIsWhole) {
  Dataset data = resting(3000, 400, 5000);
  auto x = data.trajectories[0].states.col(0);
  for (Index i = 0; i < x.size(); ++i) x[i] += i % 2 == 0 ? 1.0 : -1.0;
  EXPECT_NEAR(double(samples_in(held_blocks(data, 20))), 2100.0, 10.0);
  x.setConstant(4.0);
  EXPECT_NEAR(double(samples_in(held_blocks(data, 20))), 2100.0, 10.0);
}

TEST(HeldBlocks, ThinnedRecordsAreStretchesOfAll) {
  const Dataset data = counted({500, 300, 200});
  EXPECT_EQ(thinned(data, 1000).trajectories.size(), 3U);
  const Dataset some = thinned(data, 300);
  EXPECT_LE(some.samples(), 300);
  EXPECT_GE(some.samples(), 150);
  for (const Trajectory& record : some.trajectories)
    for (Index i = 1; i < record.samples(); ++i)
      EXPECT_EQ(record.states(i, 0) - record.states(i - 1, 0), 1.0);
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

TEST(HeldBlocks, OneSampleIsNoStretch) {
  const Dataset rest = without_blocks(counted({10}), {{0, 1, 3}, {0, 5, 5}}, 1);
  EXPECT_TRUE(rest.trajectories.empty());
}

TEST(HeldBlocks, AreLimitedInNumberAndThenInLength) {
  const std::vector<Block> many =
      limited(all_blocks(counted(std::vector<Index>(10, 100))), 300);
  EXPECT_LE(samples_in(many), 300);
  EXPECT_GT(many.back().record, 5U);
  EXPECT_EQ(samples_in(limited(all_blocks(counted({1000})), 300)), 300);
  EXPECT_EQ(samples_in(limited(all_blocks(counted({200})), 300)), 200);
}

}  // namespace
}  // namespace lacuna
