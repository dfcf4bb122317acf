// SPDX-License-Identifier: MIT
#include "regression/linear/row_pass.hpp"

#include <algorithm>
#include <cstdint>
#include <mutex>

#include "core/base/parts.hpp"
#include "core/numerics/lanes.hpp"

namespace lacuna {
namespace {

constexpr Index kChunkRows = Index{1} << 15;
constexpr Index kMaxSlots = 64;

Index round_up(Index value, Index step) { return (value + step - 1) / step * step; }

double* aligned(double* memory) {
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const auto excess = address % kCacheLine;
  return excess == 0 ? memory : memory + (kCacheLine - excess) / sizeof(double);
}

// 256 rows where they fit into 128 KiB of the second cache, fewer for wide problems: sums over
// the lanes of a vector cost as much for few rows as for many. A fact of the machines. Divides
// a chunk.
Index tile_rows(Index columns) {
  constexpr Index kCacheDoubles = 16384;
  Index rows = 256;
  while (rows > 64 && rows * columns > kCacheDoubles) rows /= 2;
  return rows;
}

}  // namespace

Scratch::Scratch(Index rows, Index columns)
    : stride_(round_up(std::max<Index>(rows, 1), kRowPadding)),
      columns_(columns),
      padded_columns_(round_up(columns, kColumnPadding)),
      storage_(new double[static_cast<std::size_t>(stride_ * padded_columns_ + kCacheLine)]()),
      data_(aligned(storage_.get())) {}

Tile::Tile(Index terms, Index targets)
    : terms_(terms),
      targets_(targets),
      capacity_(tile_rows(terms + targets)),
      scratch_(capacity_, terms + targets) {}

Index Tile::padded_rows() const noexcept { return round_up(rows_, Scratch::kRowPadding); }

void Tile::load(RowReader& reader, Index first, Index rows) {
  first_ = first;
  rows_ = rows;
  reader.read(first, theta(), targets());
  const Index padding = padded_rows() - rows_;
  if (padding > 0) {
    scratch_.block(padded_rows(), 0, terms_ + targets_).bottomRows(padding).setZero();
  }
}

std::vector<RowRange> row_slots(Index rows) {
  const Index chunks = (rows + kChunkRows - 1) / kChunkRows;
  const Index slots = std::min(chunks, kMaxSlots);
  std::vector<RowRange> ranges;
  for (Index slot = 0; slot < slots; ++slot) {
    const Index first = slot * chunks / slots * kChunkRows;
    const Index last = std::min(rows, (slot + 1) * chunks / slots * kChunkRows);
    ranges.push_back({first, last - first});
  }
  return ranges;
}

void for_each_tile(const RowSource& rows, const RunContext& context, std::string_view activity,
                   FunctionRef<void(Index slot, Tile& tile)> visit) {
  const Index total = rows.rows();
  const auto slots = row_slots(total);
  std::mutex one_reports;
  for_each_own_part(slots.size(), context, [&](std::size_t slot) {
    const auto reader = rows.open();
    Tile tile(rows.terms(), rows.targets());
    const Index end = slots[slot].first + slots[slot].count;
    for (Index row = slots[slot].first; row < end; row += tile.rows()) {
      context.check_stop();
      if (row % kChunkRows == 0) {
        const std::lock_guard lock(one_reports);
        context.report(activity, static_cast<double>(row) / static_cast<double>(total));
      }
      tile.load(*reader, row, std::min(tile.capacity(), end - row));
      visit(static_cast<Index>(slot), tile);
    }
  });
}

}  // namespace lacuna
