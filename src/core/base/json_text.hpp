// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lacuna {

/// "line:column", both from 1, of a byte, counted from 1 as JSON parsers do.
std::string line_and_column(std::string_view text, std::size_t byte);

/// Byte, from 1, of the first number in a JSON text that is beyond the range of a double.
std::optional<std::size_t> overflowing_number(std::string_view text);

/// Byte, from 1, of the first bracket in a JSON text that opens more than so many levels of
/// objects and lists. Values of JSON are copied and destroyed by recursion, which a stack
/// bounds.
std::optional<std::size_t> deeper_than(std::size_t levels, std::string_view text);

}  // namespace lacuna
