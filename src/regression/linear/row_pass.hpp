// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {

/// A column-major block of a matrix that lies in somebody else's memory.
using MatrixMap = Eigen::Map<Matrix, Eigen::Unaligned, Eigen::OuterStride<>>;

/// Scratch memory of the tile kernels: column-major, starts at a cache line, zero at first.
/// Columns are padded to whole cache lines, the number of columns to whole kernel blocks.
class Scratch {
 public:
  static constexpr Index kRowPadding = 16;    ///< rows are folded in such steps
  static constexpr Index kColumnPadding = 3;  ///< columns are folded in such blocks

  /// The next multiple of kRowPadding.
  static constexpr Index padded_rows(Index rows) {
    return (rows + kRowPadding - 1) / kRowPadding * kRowPadding;
  }

  Scratch(Index rows, Index columns);

  double* data() noexcept { return data_; }
  const double* data() const noexcept { return data_; }
  Index stride() const noexcept { return stride_; }    ///< from column to column
  Index columns() const noexcept { return columns_; }  ///< without padding
  Index padded_columns() const noexcept { return padded_columns_; }

  /// The top left block of the memory.
  MatrixMap block(Index rows, Index first_column, Index columns) noexcept {
    return {data_ + first_column * stride_, rows, columns, Eigen::OuterStride<>(stride_)};
  }

 private:
  Index stride_;
  Index columns_;
  Index padded_columns_;
  std::unique_ptr<double[]> storage_;
  double* data_;
};

/// Some consecutive rows of [Theta Y] in scratch memory; rows beyond them are zero up to the
/// next multiple of Scratch::kRowPadding.
class Tile {
 public:
  /// A tile for so many columns; its capacity keeps it within the first-level cache if it can.
  Tile(Index terms, Index targets);

  Index capacity() const noexcept { return capacity_; }
  Index first() const noexcept { return first_; }
  Index rows() const noexcept { return rows_; }
  Index padded_rows() const noexcept;
  MatrixMap theta() noexcept { return scratch_.block(rows_, 0, terms_); }
  MatrixMap targets() noexcept { return scratch_.block(rows_, terms_, targets_); }
  MatrixMap all() noexcept { return scratch_.block(rows_, 0, terms_ + targets_); }
  Scratch& scratch() noexcept { return scratch_; }

  /// Reads rows first .. first + rows - 1; rows is at most the capacity.
  void load(RowReader& reader, Index first, Index rows);

 private:
  Index terms_;
  Index targets_;
  Index capacity_;
  Scratch scratch_;
  Index first_ = 0;
  Index rows_ = 0;
};

/// Rows first .. first + count - 1.
struct RowRange {
  Index first = 0;
  Index count = 0;
};

/// Divides rows into at most 64 slots of whole chunks of 2^15 rows. Depends on the number of
/// rows only: each slot has statistics of its own, which are combined in the order of slots, so
/// that results do not depend on who folds which slot when.
std::vector<RowRange> row_slots(Index rows);

/// Reads all rows once, tile by tile, and shows each tile to `visit` with the number of its
/// slot. Tiles of a slot come in order, slots on the threads of the context; `visit` may change
/// the tile and must touch nothing but the tile and what belongs to the slot. A team divides
/// the slots; what was made of them is to be shared (core/parts.hpp).
/// @throws Cancelled on a stop request, looked at before each tile.
void for_each_tile(const RowSource& rows, const RunContext& context, std::string_view activity,
                   FunctionRef<void(Index slot, Tile& tile)> visit);

}  // namespace lacuna
