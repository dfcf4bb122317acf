// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

/// Shortest decimal text that reads back as the same double ("0.1", "1e-05" becomes "1e-05").
/// Infinity and NaN give "inf", "-inf", "nan".
std::string format_number(double value);

/// The number with the given count of significant digits, for people.
std::string format_number(double value, int significant_digits);

/// A fraction for people: "12 %", "0.34 %"; from ten times the whole on a factor, "33.7 times",
/// with the name of the whole where one is given.
std::string percent(double fraction, std::string_view whole = {});

/// The same of something: "12 % of its rate", "33.7 times its rate".
std::string percent_of(double fraction, std::string_view whole);

/// The parts with `separator` between them.
std::string join(std::span<const std::string> parts, std::string_view separator);

/// The text with blanks after it up to `width` bytes.
/// @throws ArgumentError for a width of which no line is.
std::string padded(std::string text, std::size_t width);

/// The text without blanks and tabs at either end.
std::string_view trim(std::string_view text);

/// The pieces of `text` between separators, trimmed; separators inside parentheses do not
/// count, so "x, max(x,y)" has two pieces.
std::vector<std::string> split_list(std::string_view text, char separator = ',');

/// Whole text as a double; nothing when it is not one number from end to end.
std::optional<double> parse_number(std::string_view text);

/// The known name nearest to a misspelt one, when one is near enough to suggest.
std::optional<std::string> nearest_name(std::string_view name,
                                        std::span<const std::string> known);

/// "did you mean 'stlsq'?" when a known name is near, else "known are: a, b, c".
std::string suggestion(std::string_view name, std::span<const std::string> known);

}  // namespace lacuna
