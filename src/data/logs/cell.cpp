// SPDX-License-Identifier: MIT
#include "data/logs/cell.hpp"

#include <algorithm>
#include <cctype>

#include "data/records/text_field.hpp"
#include "data/times/time_names.hpp"
#include "data/units/units.hpp"

namespace lacuna {
namespace {

bool is_name(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.empty() ? ' ' : text.front());
  return std::isalpha(first) != 0 || first == '_' || first >= 0x80U;
}

/// Without the braces and quotes that JSON has around a line and its names.
std::string_view without_braces(std::string_view text) {
  constexpr std::string_view kAround = "{}\"' \t";
  const std::size_t begin = std::min(text.find_first_not_of(kAround), text.size());
  text.remove_prefix(begin);
  while (!text.empty() && kAround.find(text.back()) != std::string_view::npos)
    text.remove_suffix(1);
  return text;
}

/// How far a number reaches: digits, signs, points and an exponent.
std::size_t end_of_number(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && std::string_view("+-.,0123456789").find(text[end]) !=
                                  std::string_view::npos)
    ++end;
  const bool exponent = end + 1 < text.size() && (text[end] == 'e' || text[end] == 'E') &&
                        std::string_view("+-0123456789").find(text[end + 1]) !=
                            std::string_view::npos;
  if (!exponent) return end;
  const std::size_t stop = text.find_first_not_of("0123456789", end + 2);
  return std::min(stop, text.size());
}

/// A number alone or in front of a known unit; Text where it is neither.
Cell quantity_of(std::string_view text) {
  const Cell none{Cell::Kind::Text, text};
  const std::size_t end = end_of_number(text);
  const std::string_view number = text.substr(0, end), rest = strip(text.substr(end));
  if (read_field(number).kind != TextField::Kind::Number) return none;
  if (rest.empty()) return {Cell::Kind::Quantity, number};
  if (const auto time = time_unit_symbol(rest); time && rest.size() > 1)
    return {Cell::Kind::Quantity, number, "", *time};
  if (!read_unit(rest)) return none;
  return {Cell::Kind::Quantity, number, "", std::string(rest)};
}

/// The number behind a label.
Cell labelled(std::string_view text) {
  const std::size_t sign = text.find_first_of(":=");
  if (sign == std::string_view::npos) return {Cell::Kind::Text, text};
  const std::string_view label = without_braces(text.substr(0, sign));
  if (!is_name(label)) return {Cell::Kind::Text, text};
  Cell cell = quantity_of(without_braces(text.substr(sign + 1)));
  cell.label = std::string(label);
  return cell;
}

}  // namespace

Cell read_cell(std::string_view text, DateOrder order) {
  text = strip(text);
  const TextField field = read_field(text);
  if (field.kind == TextField::Kind::Missing) return {Cell::Kind::Missing, text};
  if (field.kind == TextField::Kind::Number) return {Cell::Kind::Number, text};
  if (read_clock(text, order)) return {Cell::Kind::Clock, text};
  if (Cell cell = quantity_of(text); cell.kind == Cell::Kind::Quantity) return cell;
  return labelled(text);
}

}  // namespace lacuna
