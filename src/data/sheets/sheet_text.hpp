// SPDX-License-Identifier: MIT
// The cells of a sheet as a text that is read like any other.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lacuna {

/// Rows of a sheet, each with its cells as text; an empty text is a blank cell.
class SheetRows {
 public:
  /// @param source name for messages.
  explicit SheetRows(std::string source) : source_(std::move(source)) {}

  /// Puts a text into a cell, both counted from 0; blank ones need not be given.
  /// @throws DataError for more cells than any sheet of a record has.
  void put(std::size_t row, std::size_t column, std::string text);

  /// Refuses so many cells more, before they are put. @throws DataError as put().
  void expect(std::size_t cells) const;

  /// Lines with tabs between the cells: line n is row n. Tabs, line ends and quotes in cells
  /// are blanks. @throws DataError where blank cells make too many of them.
  std::string text() const;

 private:
  [[noreturn]] void refuse() const;

  std::string source_;
  std::vector<std::vector<std::string>> rows_;
  std::size_t cells_ = 0;
};

/// A date of a spreadsheet, in days since 30 December 1899 (or 1 January 1904), as
/// "2023-12-05T10:00:00"; less than a day is a time of day, "10:00:00".
std::string date_of_serial(double days, bool since_1904);

/// Whether a format of numbers ("yyyy-mm-dd hh:mm", "[h]:mm:ss") shows dates or times.
bool is_date_format(const std::string& format);

}  // namespace lacuna
