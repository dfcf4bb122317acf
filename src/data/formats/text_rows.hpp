// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/logs/damage.hpp"
#include "data/logs/range_ends.hpp"
#include "data/times/counted_times.hpp"
#include "dialects.hpp"
#include "lacuna/data/records/table.hpp"
#include "text_layout.hpp"

namespace lacuna {

/// Cells with a word for a missing value: "n.d.", "#NV".
struct MissingWords {
  std::size_t count = 0;
  std::string place = {}, word = {};  ///< of the first one
};

/// How a text is read, which its begin shows.
struct TextFormat {
  /// So many bytes determine a dialect.
  static constexpr std::size_t kBegin = std::size_t{1} << 20U;

  std::optional<TextDialect> dialect;
  TextLayout layout;  ///< of the text, or of what the dialect makes of it

  /// The first kFirstTimes lines of the numbers, as many as the begin has.
  std::string first_lines = {};
};

/// What the first lines say of the numbers in a text.
struct NumberStyle {
  char delimiter = ',';       ///< in the file
  std::size_t first_own = 0;  ///< columns in front of it are made by the dialect
  bool has_points = false;    ///< decimal points, so that commas are none
  std::optional<Index> time;  ///< column of times that are counted from the first one
  Stamp origin = 0;           ///< that one
  std::vector<std::size_t> places = {};  ///< of the columns in the file, from 0, if others
  std::vector<Index> clocks = {};        ///< columns of times where channels have their own

  /// Whether a column is counted from the origin.
  bool is_counted(Index column) const {
    return time && (column == *time ||
                    std::find(clocks.begin(), clocks.end(), column) != clocks.end());
  }

  std::size_t place_of(Index column) const {
    const auto index = static_cast<std::size_t>(column);
    return index < places.size() ? places[index] : index;
  }
};

/// The whole lines with which a text begins, up to its last line end.
std::string_view whole_lines(std::string_view text, char line_end);

/// Finds out how a text is to be read.
/// @param begin of it, TextFormat::kBegin bytes at least unless it is all.
/// @param source name for messages.
/// @return nothing where the answer may be another one with more of the text.
/// @throws DataError as find_layout(), and where this is no text.
std::optional<TextFormat> find_format(std::string_view begin, bool is_all,
                                      const std::string& source);

/// Rows of a text, which may come in blocks: so a file in memory is read, and one that does not
/// fit into it.
class TextRows {
 public:
  /// @param find the time, which is counted from its first value where doubles do not hold it.
  TextRows(TextFormat format, const std::string& source, const TimeFinder& find = no_time);

  /// The table without rows.
  const Table& columns() const noexcept { return columns_; }

  char line_end() const noexcept { return format_.layout.line_end; }

  /// Puts the rows of the next lines into a table with these columns, in the place of those
  /// that are there.
  /// @param lines whole ones, or the rest of the text; the first ones are those in which the
  ///   format was found.
  /// @throws DataError naming source, line and column of a comma that may stand for decimals or
  ///   for thousands, and of a ragged line or text in a column where there are very many; where
  ///   channels have times of their own and these are not all lines.
  void read(std::string_view lines, Table& table, bool is_all = false);

  /// Notes in columns(), behind all lines, which lines were no samples.
  /// @throws DataError naming the first line that cannot be read where there are too many
  ///   (notes_of_damage()).
  void finish();

 private:
  void read_lines(std::string_view lines, Table& table);

  TextFormat format_;
  Table columns_;
  Table file_columns_;   ///< with the times of single channels
  std::size_t skipped_;  ///< bytes in front of the rows
  std::size_t line_;     ///< number of the next line in the file
  NumberStyle style_;
  std::vector<BadLine> bad_ = {};
  MissingWords missing_ = {};
  std::string clocks_note_ = {};
  RangeEnds ends_ = {};
  std::size_t samples_ = 0, last_sample_ = 0;  ///< lines read, number of the last one
};

/// parse_text_table() with a time that is counted where doubles do not hold it.
Table parse_text(std::string_view text, const std::string& source, const TimeFinder& find);

}  // namespace lacuna
