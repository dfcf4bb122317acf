// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// Parses delimited text: comma, semicolon, tab or blanks (found by itself), an optional header
/// line with names and units in square brackets, `#` comment lines, an oscilloscope's preamble
/// before the header. Empty fields and NaN are missing values (NaN in the table).
/// @param source name for messages.
/// @throws DataError naming source, line and column of a ragged line or of text in a column.
Table parse_text_table(std::string_view text, const std::string& source);

}  // namespace lacuna
