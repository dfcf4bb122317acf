// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// A column whose values are counted from its first one, as doubles do not hold them.
struct CountedColumn {
  Index column = 0;
  double first = 0.0;  ///< the value from which they are counted, rounded
};

/// Columns of numbers as they stand in a file, before they have roles.
/// A missing value is NaN.
struct Table {
  std::string source;             ///< path, for messages
  std::vector<Quantity> columns;  ///< names (from the header or "c1", "c2", ...) and units
  Matrix values;                  ///< rows x columns

  /// Line of the file each row came from, counted from 1; empty for binary files.
  std::vector<std::size_t> lines;

  /// Rows of the file that are in front of these, where they are a part of it.
  Index rows_before = 0;

  /// Names as they stood in the header, before they were made identifiers; one per column.
  std::vector<std::string> headers;

  /// Name of a column that numbers the records, where the file says so itself; else empty.
  std::string run_column = {};

  /// The time, where it was counted from its first value before it became doubles.
  std::optional<CountedColumn> counted = {};

  /// Of times of a clock, which count from the first one: what the clock showed then, in seconds
  /// since 2000, or since midnight where there is no date.
  std::optional<double> clock_start = {};

  /// Whether channels have times of their own: there is a row for each time of any, in which the
  /// channels that have no sample then are missing.
  bool own_times = false;

  /// What the reader did that a user should know of: names changed, a preamble skipped.
  std::vector<std::string> notes;
};

/// Gives a column another name.
/// @param name identifier that no other column has.
/// @param column its name, its header as it stands in the file, or its number from 1.
/// @throws DataError when there is no such column, or the name cannot be had.
void rename_column(Table& table, const std::string& name, const std::string& column);

/// Where one value stands: "run.csv:12:3" (line, field) or "run.npy, row 12, column 3", all
/// counted from 1 in the file; row (of the table) and column count from 0 here.
std::string place(const Table& table, Index row, Index column);

/// The identifier nearest to a header text: Greek letters become their names, every run of
/// other characters an underscore; "c_" goes in front of a digit. Empty when nothing remains.
/// "Ch 1" gives "Ch_1", "\u03c6" gives "phi", "2nd" gives "c_2nd".
std::string to_identifier(std::string_view text);

/// Takes a header text apart: the unit is in brackets or parentheses at its end, or a known one
/// behind a comma: "x [V]", "x (V)", "x, V"; a remark with a colon ("(S/N: 1)") is left out.
/// Digits in brackets belong to the name ("position[0]"), but for the unit of "x [1]".
Quantity split_header(std::string_view text);

/// Gives a table its column names. A header that is no identifier or is a word of the
/// expression language (other than `t`) is changed, which is noted; an empty one becomes "c"
/// and its number.
/// @param headers one for each column, with the name as written.
/// @param line of the header in the file, for messages; nothing for binary files.
/// @throws DataError when two columns have the same name.
void name_columns(Table& table, const std::vector<Quantity>& headers,
                  std::optional<std::size_t> line);

}  // namespace lacuna
