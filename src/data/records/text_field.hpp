// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

/// What one field of a delimited text holds.
struct TextField {
  enum class Kind { Number, Missing, Text };
  Kind kind = Kind::Missing;
  double value = 0.0;  ///< of a Number; NaN when missing
};

/// Reads one field: a number (decimal commas, thousands beside them and the sign of infinity are
/// known; quotes are ignored), a missing value (nothing, nan, na, n/a, n.d., nd, -, #nv, #n/a,
/// null, none) or text.
TextField read_field(std::string_view field);

/// Cuts a line into trimmed fields, without their quotes. A delimiter inside quotes does not
/// count; blanks (delimiter ' ': any run of blanks and tabs) do not count inside square
/// brackets or in front of them, so that "t [s] F [N m]" has two fields.
void split_fields(std::string_view line, char delimiter, std::vector<std::string_view>& fields);

/// Text without blanks, tabs and carriage returns at either end.
std::string_view strip(std::string_view text);

/// The text in lower case (ASCII).
std::string lower_case(std::string_view text);

}  // namespace lacuna
