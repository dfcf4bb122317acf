// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// How a delimited text is laid out.
struct TextLayout {
  char delimiter = ',';             ///< one of , ; tab blank
  char line_end = '\n';             ///< '\r' in texts that have no '\n'
  std::vector<Quantity> headers;    ///< one for each column; empty names without a header line
  std::size_t data_begin = 0;       ///< offset of the first line of numbers
  std::size_t data_line = 1;        ///< its number in the file, from 1
  bool trailing_delimiter = false;  ///< lines end with a delimiter that opens no column
  std::optional<std::size_t> header_line;  ///< number of the header line, if there is one
  std::optional<std::string> note;         ///< preamble that was skipped

  std::size_t columns() const noexcept { return headers.size(); }
};

/// Symbol of a unit that stands in a line of units below the names ("Volt", "[V]"); empty when
/// it is none.
std::string unit_symbol(std::string_view field);

/// Puts the units of a line below the names into the headers.
/// @return false when the line is not one of units only.
bool take_units(const std::vector<std::string_view>& fields, std::vector<Quantity>& headers);

/// '\r' in texts that have no '\n'.
char line_end_of(std::string_view text);

/// Finds the layout: the data begin at the first line whose fields are all numbers or missing;
/// the header is the line of names in front of it (with a line of units between them, if there
/// is one); what stands above is a preamble. Lines that start with # and empty lines do not
/// count.
/// @param source name for messages.
/// @throws DataError when there is no line of numbers, when the header does not fit the data or
///   when the line in front of the data mixes numbers and text.
TextLayout find_layout(std::string_view text, const std::string& source);

/// Whether more of a text would change nothing in the layout that was found at its begin.
/// @param begin whole lines.
bool shows_layout(std::string_view begin, const TextLayout& layout);

}  // namespace lacuna
