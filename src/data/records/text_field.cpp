// SPDX-License-Identifier: MIT
#include "data/records/text_field.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <optional>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view unquote(std::string_view text) {
  text = strip(text);
  const bool quoted = text.size() >= 2 && text.front() == text.back() &&
                      (text.front() == '"' || text.front() == '\'');
  return quoted ? strip(text.substr(1, text.size() - 2)) : text;
}

/// What programs write in the place of a value that is not there ("NA" of R, "#NV" of Excel).
bool is_missing(std::string_view field) {
  constexpr std::array<std::string_view, 12> kWords{
      "", "nan", "-nan", "na", "n/a", "n.d.", "nd", "-", "#nv", "#n/a", "null", "none"};
  constexpr std::size_t kLongest = 4;  // a fact of the words above
  if (field.size() > kLongest) return false;
  const std::string word = lower_case(field);
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

std::optional<double> decimal_comma_number(std::string_view field) {
  if (std::count(field.begin(), field.end(), ',') != 1) return std::nullopt;
  if (field.find('.') != std::string_view::npos) return std::nullopt;
  std::string copy(field);
  std::replace(copy.begin(), copy.end(), ',', '.');
  return parse_number(copy);
}

/// "1.200,5" and "1,200.5": groups of three digits in front of the last separator.
std::optional<double> grouped_number(std::string_view field) {
  constexpr std::size_t kGroup = 3;  // a fact of writing
  const std::size_t first = field.find_first_of(".,"), last = field.find_last_of(".,");
  if (first == std::string_view::npos || field[first] == field[last]) return std::nullopt;
  if (field.find(field[last]) != last) return std::nullopt;
  std::string plain(field.substr(0, first));
  for (std::size_t at = first; at < last; at += kGroup + 1) {
    if (field[at] != field[first] || last - at <= kGroup) return std::nullopt;
    plain += field.substr(at + 1, kGroup);
  }
  if (plain.find_first_not_of("0123456789", plain.starts_with('-') ? 1 : 0) != std::string::npos)
    return std::nullopt;
  return parse_number(plain + "." + std::string(field.substr(last + 1)));
}

/// What oscilloscopes write where a signal is beyond their range.
std::optional<double> infinite_sign(std::string_view field) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (field == "\u221e" || field == "+\u221e") return kInfinity;
  if (field == "-\u221e") return -kInfinity;
  return std::nullopt;
}

/// The minus sign of typesetting, U+2212, as the one of numbers; nothing where there is none.
std::optional<std::string> with_plain_minus(std::string_view field) {
  constexpr std::string_view kMinus = "\u2212";
  std::string plain(field);
  std::size_t at = plain.find(kMinus);
  if (at == std::string::npos) return std::nullopt;
  for (; at != std::string::npos; at = plain.find(kMinus, at))
    plain.replace(at, kMinus.size(), "-");
  return plain;
}

void split_blanks(std::string_view line, std::vector<std::string_view>& fields) {
  std::size_t begin = 0;
  while (begin < line.size()) {
    int depth = 0;
    std::size_t end = begin;
    for (; end < line.size(); ++end) {
      if (line[end] == '[') ++depth;
      if (line[end] == ']' && depth > 0) --depth;
      if (depth > 0 || !is_blank(line[end])) continue;
      const std::size_t next = std::min(line.find_first_not_of(" \t\r", end), line.size());
      if (next == line.size() || line[next] != '[') break;
    }
    fields.push_back(unquote(line.substr(begin, end - begin)));
    begin = std::min(line.find_first_not_of(" \t\r", end), line.size());
  }
}

}  // namespace

std::string_view strip(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

TextField read_field(std::string_view field) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  field = unquote(field);
  if (is_missing(field)) return {TextField::Kind::Missing, kNothing};
  if (const auto value = parse_number(field)) return {TextField::Kind::Number, *value};
  if (const auto value = decimal_comma_number(field)) return {TextField::Kind::Number, *value};
  if (const auto value = grouped_number(field)) return {TextField::Kind::Number, *value};
  if (const auto value = infinite_sign(field)) return {TextField::Kind::Number, *value};
  if (const auto plain = with_plain_minus(field)) return read_field(*plain);
  return {TextField::Kind::Text, kNothing};
}

void split_fields(std::string_view line, char delimiter,
                  std::vector<std::string_view>& fields) {
  fields.clear();
  if (delimiter == ' ') return split_blanks(strip(line), fields);
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] != delimiter || quoted) continue;
    fields.push_back(unquote(line.substr(begin, i - begin)));
    begin = i + 1;
  }
  fields.push_back(unquote(line.substr(begin)));
}

}  // namespace lacuna
