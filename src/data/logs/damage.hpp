// SPDX-License-Identifier: MIT
// Lines of a record that are no samples: stray bytes, cut lines, summaries of spreadsheets.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/core/base/error.hpp"

namespace lacuna {

/// A line that cannot be read.
struct BadLine {
  enum class Kind {
    Other,    ///< ragged, or text where a number belongs
    Stray,    ///< it has bytes that no text has
    Cut,      ///< the last one, without a line end and with fewer fields than the others
    Summary,  ///< of a spreadsheet: its first field is "Mean", "Sum", ...
  };
  Kind kind = Kind::Other;
  std::size_t number = 0;  ///< in the file, from 1
  std::string text;        ///< shortened
  DataError error;         ///< why it cannot be read
};

/// Whether no text has such a byte: a control other than tab and line end.
bool is_stray_byte(char byte);

/// The kind of a line that cannot be read.
/// @param has_end whether there is a line end behind it.
/// @param is_short whether it has fewer fields than the others.
BadLine::Kind kind_of_bad_line(std::string_view line, bool has_end, bool is_short);

/// Whether a line is a row of statistics that a spreadsheet has behind its numbers.
bool is_summary(std::string_view line);

/// So many are kept; a file with more is no record.
inline constexpr std::size_t kMostBadLines = 1000;

/// What becomes of the lines that cannot be read, when all have been seen: notes where they are
/// few, or a summary behind the last sample.
/// @param samples lines that could be read. @param last_sample number of the last one.
/// @throws DataError the first one's, where they are too many.
std::vector<std::string> notes_of_damage(const std::vector<BadLine>& lines, std::size_t samples,
                                         std::size_t last_sample, const std::string& source);

}  // namespace lacuna
