// SPDX-License-Identifier: MIT
#include "regression/linear/row_pass.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <stop_token>
#include <vector>

namespace lacuna {
namespace {

TEST(RowSlots, CoverAllRowsInOrder) {
  for (const Index rows : {Index{0}, Index{1}, Index{32768}, Index{32769}, Index{5'000'000}}) {
    Index next = 0;
    for (const RowRange& range : row_slots(rows)) {
      EXPECT_EQ(range.first, next);
      EXPECT_GT(range.count, 0);
      next += range.count;
    }
    EXPECT_EQ(next, rows);
  }
}

TEST(RowSlots, AreAtMost64OfWholeChunks) {
  EXPECT_EQ(row_slots(32768).size(), 1u);
  EXPECT_EQ(row_slots(32769).size(), 2u);
  const auto slots = row_slots(100'000'000);
  EXPECT_EQ(slots.size(), 64u);
  for (const RowRange& range : slots) EXPECT_EQ(range.first % 32768, 0);
}

TEST(Scratch, StartsAtACacheLineAndIsZero) {
  Scratch scratch(17, 4);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(scratch.data()) % 64, 0u);
  EXPECT_EQ(scratch.stride(), 32);
  EXPECT_EQ(scratch.padded_columns(), 6);
  EXPECT_TRUE(scratch.block(32, 0, 6).isZero(0.0));
}

TEST(Tile, KeepsPaddingZeroWhenRowsGetFewer) {
  const auto rows = make_row_source(Matrix::Ones(256, 2), Matrix::Ones(256, 1));
  const auto reader = rows->open();
  Tile tile(2, 1);
  tile.load(*reader, 0, 200);
  tile.load(*reader, 200, 19);
  EXPECT_EQ(tile.padded_rows(), 32);
  EXPECT_TRUE(tile.scratch().block(19, 0, 3).isOnes(0.0));
  EXPECT_TRUE(tile.scratch().block(32, 0, 3).bottomRows(13).isZero(0.0));
}

TEST(ForEachTile, ShowsEveryRowOnceWithItsSlot) {
  const Index count = 70'000;
  const auto rows =
      make_row_source(Vector::LinSpaced(count, 0.0, double(count - 1)), Matrix::Ones(count, 1));
  std::vector<double> seen(row_slots(count).size(), 0.0);
  Index next = 0;
  for_each_tile(*rows, {}, "test", [&](Index slot, Tile& tile) {
    EXPECT_EQ(tile.first(), next);
    EXPECT_EQ(tile.theta()(0, 0), static_cast<double>(next));
    next += tile.rows();
    seen[static_cast<std::size_t>(slot)] += tile.targets().sum();
  });
  EXPECT_EQ(next, count);
  EXPECT_EQ(seen, (std::vector<double>{32768.0, 32768.0, 4464.0}));
}

TEST(ForEachTile, ReportsEveryChunkAndStops) {
  const auto rows = make_row_source(Matrix::Ones(100'000, 1), Matrix::Ones(100'000, 1));
  std::stop_source stop;
  RunContext context;
  context.stop = stop.get_token();
  std::vector<double> fractions;
  context.progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.activity, "test");
    fractions.push_back(progress.fraction);
    if (fractions.size() == 2) stop.request_stop();
  };
  Index rows_seen = 0;
  EXPECT_THROW(for_each_tile(*rows, context, "test",
                             [&](Index, Tile& tile) { rows_seen += tile.rows(); }),
               Cancelled);
  EXPECT_GE(rows_seen, 32768);
  EXPECT_LT(rows_seen, 32768 + 300);  // it ends with the tile
  EXPECT_EQ(fractions, (std::vector<double>{0.0, 0.32768}));
}

}  // namespace
}  // namespace lacuna
