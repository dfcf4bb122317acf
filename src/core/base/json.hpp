// SPDX-License-Identifier: MIT
// JSON to text and back, compiled once: parser and printer cost each folder seconds.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace lacuna {

using OrderedJson = nlohmann::ordered_json;  ///< keys as they were added
using SortedJson = nlohmann::json;           ///< keys by name: soon found among many

/// What the library itself wrote; files that somebody gives are read by parse_strict_json().
/// @throws nlohmann::json::parse_error.
OrderedJson ordered_json(std::string_view text);
SortedJson sorted_json(std::string_view text);

/// Whether a text is JSON.
bool is_json(std::string_view text);

/// In one line; what is no UTF-8 is replaced.
std::string json_line(const OrderedJson& json);
std::string json_line(const SortedJson& json);

/// With a line for each value, indented by so many blanks for each level, and a line end.
std::string json_lines(const OrderedJson& json, int indent = 2);

}  // namespace lacuna
