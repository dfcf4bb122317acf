// SPDX-License-Identifier: MIT
#include "lacuna/data/records/table.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/base/names.hpp"
#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "data/units/units.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

/// Greek alphabet in the order of Unicode, from U+0391 and U+03B1 on.
constexpr std::array<std::string_view, 25> kGreek{
    "alpha", "beta",   "gamma",   "delta", "epsilon", "zeta",    "eta",  "theta", "iota",
    "kappa", "lambda", "mu",      "nu",    "xi",      "omicron", "pi_",  "rho",   "sigma",
    "sigma", "tau",    "upsilon", "phi",   "chi",     "psi",     "omega"};

/// Name of the Greek letter with this code point; empty for any other.
std::string greek_name(unsigned code) {
  const bool capital = code >= 0x391 && code <= 0x3A9;
  const bool small = code >= 0x3B1 && code <= 0x3C9;
  if (!capital && !small) return code == 0xB5 ? "u" : "";
  std::string name(kGreek[code - (capital ? 0x391U : 0x3B1U)]);
  if (capital) name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

/// Name of the two-byte UTF-8 letter that starts at `i`; empty when there is none.
std::string greek_at(std::string_view text, std::size_t i) {
  const auto first = static_cast<unsigned char>(text[i]);
  if (first < 0xC2 || first > 0xDF || i + 1 >= text.size()) return "";
  const auto second = static_cast<unsigned char>(text[i + 1]);
  return greek_name(((first & 0x1FU) << 6U) | (second & 0x3FU));
}

/// Where the bracket opens that closes at the end of a text; npos where none does.
std::size_t last_bracket(std::string_view text, char open, char close) {
  int depth = 0;
  for (std::size_t i = text.size(); i-- > 0;) {
    if (text[i] == close) ++depth;
    if (text[i] == open && --depth == 0) return i;
    if (depth == 0) break;
  }
  return std::string_view::npos;
}

/// Digits right behind a name are an index of it: "position[0]"; "x [1]" has the unit 1.
bool is_index(std::string_view inside, std::string_view before) {
  const bool digits = !inside.empty() && std::all_of(inside.begin(), inside.end(), is_digit);
  return digits && !(inside == "1" && before.ends_with(' '));
}

std::optional<Quantity> split_brackets(std::string_view text, char open, char close) {
  const std::size_t begin = last_bracket(text, open, close);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::string_view before = text.substr(0, begin);
  const std::string_view unit = trim(text.substr(begin + 1, text.size() - begin - 2));
  if (is_index(unit, before)) return Quantity{std::string(text), ""};
  return Quantity{std::string(trim(before)), std::string(unit)};
}

/// What stands in parentheses at the end and is a remark, no unit: "(SEN S/N: 1234, LBL: Tank)".
std::string_view without_remark(std::string_view text) {
  const std::size_t open = text.rfind('(');
  if (open == std::string_view::npos || open == 0 || text.back() != ')') return text;
  const bool is_remark = text.substr(open).find(':') != std::string_view::npos;
  return is_remark ? trim(text.substr(0, open)) : text;
}

/// "Temp, degC": a known unit behind a comma.
std::optional<Quantity> split_comma(std::string_view text) {
  const std::size_t comma = text.rfind(", ");
  if (comma == std::string_view::npos || comma == 0) return std::nullopt;
  const std::string_view unit = trim(text.substr(comma + 2));
  if (!read_unit(unit)) return std::nullopt;
  return Quantity{std::string(trim(text.substr(0, comma))), std::string(unit)};
}

/// "V(th)", "I(L1)", "Ic(Q1)" are names that circuit simulators give; "V(V)" and "I(mA)" a name
/// and a unit.
bool is_probe(std::string_view text) {
  const std::size_t open = text.find('(');
  if (open == std::string_view::npos || open == 0 || open > 2 || text.back() != ')')
    return false;
  const char kind = text[0];
  const bool voltage = (kind == 'V' || kind == 'v') && open == 1;
  const bool current = kind == 'I' || kind == 'i';
  const std::string_view inside = text.substr(open + 1, text.size() - open - 2);
  if (inside.empty() || (!voltage && !current)) return false;
  const bool prefixed = inside.size() == 2 &&
                        std::string_view("pnumkM").find(inside[0]) != std::string_view::npos;
  return !((inside.size() == 1 || prefixed) && inside.back() == (voltage ? 'V' : 'A'));
}

std::string default_name(std::size_t column) {
  std::string name = "c";
  return name += std::to_string(column + 1);
}

std::string usable_name(const std::string& header, std::size_t column) {
  std::string name = is_identifier(header) ? header : to_identifier(header);
  if (name.empty()) return default_name(column);
  if (name != "t" && is_reserved_name(name)) name += '_';
  return name.substr(0, kLongestName);
}

std::string header_place(const Table& table, std::optional<std::size_t> line,
                         std::size_t column) {
  const std::string number = std::to_string(column + 1);
  if (!line) return table.source + ", column " + number;
  return table.source + ":" + std::to_string(*line) + ":" + number;
}

/// Columns by their names.
using Places = std::unordered_map<std::string, std::size_t>;

void check_distinct(const Table& table, std::size_t column, std::optional<std::size_t> line,
                    Places& places) {
  const std::string& name = table.columns[column].name;
  const auto [other, is_new] = places.emplace(name, column);
  if (is_new) return;
  throw DataError(header_place(table, line, column),
                  "columns " + std::to_string(other->second + 1) + " and " +
                      std::to_string(column + 1) + " are both named '" + name + "'",
                  "give every column a name of its own in the header");
}

}  // namespace

std::string place(const Table& table, Index row, Index column) {
  const std::string number = std::to_string(column + 1);
  const auto index = static_cast<std::size_t>(row);
  if (index < table.lines.size())
    return table.source + ":" + std::to_string(table.lines[index]) + ":" + number;
  return table.source + ", row " + std::to_string(table.rows_before + row + 1) + ", column " +
         number;
}

std::string to_identifier(std::string_view text) {
  std::string name;
  bool gap = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string piece = is_word(text[i]) ? std::string(1, text[i]) : greek_at(text, i);
    if (piece.empty()) {
      gap = true;
      continue;
    }
    if (!is_word(text[i])) ++i;
    if (gap && !name.empty()) name += '_';
    gap = false;
    name += piece;
  }
  if (!name.empty() && is_digit(name[0])) name.insert(0, "c_");
  return name;
}

Quantity split_header(std::string_view text) {
  text = without_remark(trim(text));
  if (const auto squared = split_brackets(text, '[', ']')) return *squared;
  if (is_probe(text)) return Quantity{std::string(text), ""};
  if (const auto round = split_brackets(text, '(', ')')) return *round;
  if (const auto behind_comma = split_comma(text)) return *behind_comma;
  return Quantity{std::string(text), ""};
}

void name_columns(Table& table, const std::vector<Quantity>& headers,
                  std::optional<std::size_t> line) {
  table.columns.clear();
  table.headers.clear();
  Places places;
  for (std::size_t i = 0; i < headers.size(); ++i) {
    const std::string header = to_utf8(headers[i].name);
    table.headers.push_back(header);
    const std::string unit = to_utf8(headers[i].unit);
    table.columns.push_back({usable_name(header, i), cleaned_unit(unit)});
    check_distinct(table, i, line, places);
    const Quantity& column = table.columns.back();
    if (!header.empty() && column.name != header)
      table.notes.push_back(header_place(table, line, i) + ": column '" + printable(header) +
                            "' is called '" + column.name + "'");
    if (column.unit != trim(unit))
      table.notes.push_back(header_place(table, line, i) + ": the unit '" + printable(unit) +
                            "' of '" + column.name + "' is read as '" + column.unit + "'");
  }
}

namespace {

/// The column of a name, a header or a number from 1.
std::optional<std::size_t> place_of_column(const Table& table, const std::string& text) {
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (table.columns[i].name == text) return i;
  for (std::size_t i = 0; i < std::min(table.headers.size(), table.columns.size()); ++i)
    if (table.headers[i] == text) return i;
  const std::optional<double> number = parse_number(text);
  if (!number || *number != std::floor(*number) || *number < 1.0 ||
      *number > static_cast<double>(table.columns.size()))
    return std::nullopt;
  return static_cast<std::size_t>(*number) - 1;
}

}  // namespace

void rename_column(Table& table, const std::string& name, const std::string& column) {
  std::vector<std::string> known;
  for (const Quantity& one : table.columns) known.push_back(one.name);
  const auto place = place_of_column(table, column);
  if (!place)
    throw DataError(table.source, "there is no column '" + column + "' to be called " + name,
                    suggestion(column, known));
  const auto fault = name == "t" ? std::nullopt : name_fault(name);
  if (fault) throw DataError(table.source, fault->problem, fault->remedy);
  const auto other = std::find(known.begin(), known.end(), name);
  if (other != known.end() && other != known.begin() + static_cast<std::ptrdiff_t>(*place))
    throw DataError(table.source, "another column is called '" + name + "' already",
                    "give that one another name too");
  table.columns[*place].name = name;
}

}  // namespace lacuna
