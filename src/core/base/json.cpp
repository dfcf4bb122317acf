// SPDX-License-Identifier: MIT
#include "core/base/json.hpp"

#include <nlohmann/json.hpp>

namespace lacuna {
namespace {

template <class Json>
std::string printed(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

OrderedJson ordered_json(std::string_view text) { return OrderedJson::parse(text); }

SortedJson sorted_json(std::string_view text) { return SortedJson::parse(text); }

bool is_json(std::string_view text) { return SortedJson::accept(text); }

std::string json_line(const OrderedJson& json) { return printed(json, -1); }

std::string json_line(const SortedJson& json) { return printed(json, -1); }

std::string json_lines(const OrderedJson& json, int indent) {
  return printed(json, indent) + "\n";
}

}  // namespace lacuna
