// SPDX-License-Identifier: MIT
#include "lacuna/core/base/names.hpp"

#include <algorithm>
#include <array>

namespace lacuna {
namespace {

constexpr std::array<std::string_view, 21> kReserved{
    "sin",  "cos",  "tan", "asin", "acos", "atan",  "tanh", "exp", "log", "sqrt", "abs",
    "sign", "step", "min", "max",  "clip", "delay", "pi",   "t",   "inf", "nan"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_letter_or_digit(char c) { return is_letter(c) || (c >= '0' && c <= '9'); }

}  // namespace

bool is_identifier(std::string_view text) noexcept {
  return !text.empty() && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(), is_letter_or_digit);
}

bool is_reserved_name(std::string_view name) noexcept {
  return std::find(kReserved.begin(), kReserved.end(), name) != kReserved.end();
}

}  // namespace lacuna
