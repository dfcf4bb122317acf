// SPDX-License-Identifier: MIT
#include "core/base/names.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "core/base/text.hpp"
#include "utf8.hpp"

namespace lacuna {
namespace {

constexpr std::array<std::string_view, 21> kReserved{
    "sin",  "cos",  "tan", "asin", "acos", "atan",  "tanh", "exp", "log", "sqrt", "abs",
    "sign", "step", "min", "max",  "clip", "delay", "pi",   "t",   "inf", "nan"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_letter_or_digit(char c) { return is_letter(c) || (c >= '0' && c <= '9'); }

struct Range {
  char32_t first, last;
};

/// Characters of units, in order. None combines with one before it, none has another composed
/// form (Unicode's NFC_Quick_Check is yes, the combining class 0), none is written from right
/// to left: without the ohm, kelvin and angstrom signs (U+2126, U+212A, U+212B), which are
/// other shapes of letters.
constexpr std::array<Range, 19> kUnitCharacters{{{0x20, 0x5A},
                                                 {0x5C, 0x5C},
                                                 {0x5E, 0x7E},
                                                 {0xA1, 0xAC},
                                                 {0xAE, 0x17F},
                                                 {0x388, 0x482},
                                                 {0x48A, 0x52F},
                                                 {0x1E00, 0x1EFF},
                                                 {0x2010, 0x2027},
                                                 {0x2030, 0x205E},
                                                 {0x2070, 0x20CF},
                                                 {0x2100, 0x2125},
                                                 {0x2127, 0x2129},
                                                 {0x212C, 0x22FF},
                                                 {0x3041, 0x3096},
                                                 {0x30A1, 0x30FE},
                                                 {0x3371, 0x33DF},
                                                 {0x4E00, 0x9FFF},
                                                 {0xAC00, 0xD7A3}}};

bool is_unit_character(char32_t c) {
  const auto range =
      std::lower_bound(kUnitCharacters.begin(), kUnitCharacters.end(), c,
                       [](const Range& one, char32_t wanted) { return one.last < wanted; });
  return range != kUnitCharacters.end() && range->first <= c;
}

bool is_wide_blank(char32_t c) {
  return c == 0xA0 || c == 0x1680 || (c >= 0x2000 && c <= 0x200A) || c == 0x202F ||
         c == 0x205F || c == 0x3000;
}

/// The character of units that another one is a writing of; 0 where there is none.
char32_t plain_character(char32_t c) {
  if (c == '[') return '(';
  if (c == ']') return ')';
  if (c == 0x2126) return 0x3A9;  // ohm
  if (c == 0x212A) return 'K';    // kelvin
  if (c == 0x212B) return 0xC5;   // angstrom
  if (is_wide_blank(c) || (c >= '\t' && c <= '\r')) return ' ';
  constexpr char32_t kFirstFull = 0xFF01, kLastFull = 0xFF5E;
  if (c < kFirstFull || c > kLastFull) return 0;
  const char32_t narrow = c - kFirstFull + '!';
  return is_unit_character(narrow) ? narrow : plain_character(narrow);
}

std::string code_text(char32_t c) {
  std::array<char, 16> text;
  std::snprintf(text.data(), text.size(), "U+%04X", static_cast<unsigned>(c));
  return text.data();
}

/// The text for a message of one line: not too long, with everything in it seen.
std::string shown(std::string_view text) {
  // For people: letters of what a message repeats.
  constexpr std::size_t kShown = 60;
  std::size_t end = 0;
  while (end < std::min(kShown, text.size()))
    end += std::max<std::size_t>(1, utf8_length(text, end));
  std::string result = printable(text.substr(0, end));
  for (std::size_t i = result.find('\n'); i != std::string::npos; i = result.find('\n', i))
    result.replace(i, 1, "\\n");
  return end < text.size() ? result + "..." : result;
}

/// Whether the character ends a line somewhere: CR, vertical tab, form feed, NEL and
/// separators.
bool ends_line(char32_t c) {
  return (c >= 0x0B && c <= 0x0D) || c == 0x85 || c == 0x2028 || c == 0x2029;
}

constexpr std::string_view kNotUtf8 = "is not UTF-8";

TextFault length_fault(const std::string& what, std::string_view text) {
  return {what + " '" + shown(text) + "' has " + std::to_string(text.size()) + " bytes",
          "at most " + std::to_string(kLongestName) + " are taken; shorten it", kLongestName};
}

std::string remedy_for(char32_t c) {
  const char32_t plain = plain_character(c);
  if (plain == 0 || plain == ' ')
    return is_unseen(c) ? "remove it"
                        : (plain == ' ' ? "write a blank" : "write it in other letters");
  return "write " + utf8_of(plain) + " (" + code_text(plain) + ")";
}

}  // namespace

bool is_identifier(std::string_view text) noexcept {
  return !text.empty() && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(), is_letter_or_digit);
}

bool is_reserved_name(std::string_view name) noexcept {
  return std::find(kReserved.begin(), kReserved.end(), name) != kReserved.end();
}

std::optional<TextFault> name_fault(std::string_view name) {
  if (!is_identifier(name))
    return TextFault{"the name '" + shown(name) + "' is not an identifier",
                     "use letters, digits and underscores, a letter first"};
  if (is_reserved_name(name))
    return TextFault{"the name '" + std::string(name) + "' is a word of the formula language",
                     "choose another"};
  if (name.size() > kLongestName) return length_fault("the name", name);
  return std::nullopt;
}

std::optional<TextFault> unit_fault(std::string_view unit) {
  for (std::size_t i = 0; i < unit.size();) {
    const std::size_t length = utf8_length(unit, i);
    if (length == 0)
      return TextFault{"the unit '" + shown(unit) + "' " + std::string(kNotUtf8),
                       "write it in UTF-8 or plain letters", i};
    const char32_t c = code_point(unit, i);
    if (!is_unit_character(c))
      return TextFault{"the unit '" + shown(unit) + "' has the character " + code_text(c),
                       remedy_for(c), i};
    i += length;
  }
  if (trim(unit) != unit)
    return TextFault{"the unit '" + shown(unit) + "' begins or ends with a blank", "remove it"};
  if (unit.size() > kLongestName) return length_fault("the unit", unit);
  return std::nullopt;
}

std::optional<TextFault> comment_fault(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    if (length == 0)
      return TextFault{"the text " + std::string(kNotUtf8), "write it in UTF-8", i};
    const char32_t c = code_point(text, i);
    const bool layout = c == '\t' || c == '\n';
    if (!layout && is_unseen(c))
      return TextFault{"the character " + code_text(c) + " stands here, which is not seen",
                       ends_line(c) ? "end lines by a line feed" : "remove it", i};
    i += length;
  }
  return std::nullopt;
}

std::string cleaned_unit(std::string_view text) {
  std::string unit;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = std::max<std::size_t>(1, utf8_length(text, i));
    const char32_t c = code_point(text, i);
    i += length;
    const char32_t plain = is_unit_character(c) ? c : plain_character(c);
    if (plain == 0 && is_unseen(c)) continue;
    const std::string piece = utf8_of(plain == 0 ? char32_t{'?'} : plain);
    if (unit.size() + piece.size() > kLongestName) break;
    unit += piece;
  }
  return std::string(trim(unit));
}

}  // namespace lacuna
