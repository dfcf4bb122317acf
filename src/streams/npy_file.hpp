// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "core/positioned_file.hpp"
#include "data/npy_header.hpp"
#include "lacuna/data/table.hpp"

namespace lacuna {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A NumPy array in a file, read by rows.
class NpyFile {
 public:
  /// @throws FileError when it cannot be read; DataError when it is no such array.
  explicit NpyFile(const std::filesystem::path& path);

  Index rows() const noexcept { return static_cast<Index>(header_.rows); }

  /// Its columns, without rows; what is changed here is found in what is read.
  Table& columns() noexcept { return columns_; }
  const Table& columns() const noexcept { return columns_; }

  /// Rows [first, first + count) as a table. Its places count from `first`.
  Table read(Index first, Index count) const;

  /// The numbers of these rows.
  Matrix values(Index first, Index count) const;

  /// The same row by row, as they stand in the file; nothing where they are not doubles of this
  /// machine in this order.
  std::optional<RowMajorMatrix> plain_rows(Index first, Index count) const;

 private:
  PositionedFile file_;
  NpyHeader header_;
  Table columns_;
};

}  // namespace lacuna
