// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/positioned_file.hpp"
#include "data/formats/npy_header.hpp"
#include "data/times/counted_times.hpp"
#include "lacuna/data/records/table.hpp"
#include "line_numbers.hpp"

namespace lacuna {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A NumPy array in a file, read by rows.
class NpyFile {
 public:
  /// @throws FileError when it cannot be read; DataError when it is no such array.
  explicit NpyFile(const std::filesystem::path& path);

  /// The same of a file that is open.
  /// @param source name for messages.
  NpyFile(PositionedFile file, const std::string& source);

  /// An array that was made of the rows of another file.
  /// @param columns of that one, without rows.
  /// @param lines of it from which the rows came; empty where it is no text.
  NpyFile(PositionedFile file, Table columns, LineNumbers lines);

  Index rows() const noexcept { return static_cast<Index>(header_.rows); }

  /// Its columns, without rows; what is changed here is found in what is read.
  Table& columns() noexcept { return columns_; }
  const Table& columns() const noexcept { return columns_; }

  /// Looks at the first times, and counts them from the first one from here on where doubles do
  /// not hold them; the columns say so.
  void look_at_times(const TimeColumn& time);

  /// Rows [first, first + count) as a table. Its places count from `first`.
  Table read(Index first, Index count) const;

  /// The numbers of these rows.
  Matrix values(Index first, Index count) const;

  /// The same row by row, as they stand in the file; nothing where they are not doubles of this
  /// machine in this order.
  std::optional<RowMajorMatrix> plain_rows(Index first, Index count) const;

  /// Lines of the text from which these rows came; empty where they are not known.
  std::vector<std::size_t> lines(Index first, Index count) const {
    return lines_.of(first, count);
  }

 private:
  /// Rows as they stand in the file.
  struct Bytes {
    NpyHeader header;  ///< with the number of these rows
    std::unique_ptr<char[]> data;
    std::size_t size = 0;

    std::string_view view() const { return {data.get(), size}; }
  };
  Bytes bytes_of(Index first, Index count) const;

  PositionedFile file_;
  NpyHeader header_;
  Table columns_;
  LineNumbers lines_;
  std::optional<Stamp> origin_;  ///< from which the times are counted when they are read
};

}  // namespace lacuna
