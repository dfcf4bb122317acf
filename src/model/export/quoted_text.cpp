// SPDX-License-Identifier: MIT
#include "model/export/quoted_text.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "core/base/utf8.hpp"

namespace lacuna {
namespace {

// For people.
constexpr std::size_t kLongestQuote = 100;
constexpr std::size_t kCommentColumns = 92;

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// Whether a character may stand as it is behind another.
bool is_plain(char c, char before) {
  constexpr std::string_view kAlone = " _.,()+-%", kNotTogether = "*/^", kMarks = "*/^-";
  if (is_letter_or_digit(c) || kAlone.find(c) != std::string_view::npos) return true;
  return kNotTogether.find(c) != std::string_view::npos &&
         kMarks.find(before) == std::string_view::npos;
}

/// The number of a UTF-8 character of that many bytes.
unsigned code_point(std::string_view bytes) {
  const auto first = static_cast<unsigned char>(bytes.front());
  if (bytes.size() == 1) return first;
  unsigned number = first & (0xFFU >> (bytes.size() + 1));
  for (const char c : bytes.substr(1))
    number = number << 6U | (static_cast<unsigned char>(c) & 0x3FU);
  return number;
}

std::string numbered(const char* format, unsigned number) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), format, number);
  return text.data();
}

}  // namespace

std::string quoted_text(std::string_view text) {
  std::string safe;
  for (std::size_t i = 0; i < text.size();) {
    if (safe.size() > kLongestQuote) return safe + "...";
    const std::size_t length = utf8_length(text, i);
    if (length == 0)
      safe += numbered("<0x%02X>", static_cast<unsigned char>(text[i]));
    else if (length == 1 && is_plain(text[i], i > 0 ? text[i - 1] : ' '))
      safe += text[i];
    else
      safe += numbered("<U+%04X>", code_point(text.substr(i, length)));
    i += length == 0 ? 1 : length;
  }
  return safe;
}

std::string comment_lines(std::string_view sign, std::string_view text) {
  std::string lines(sign);
  std::size_t column = sign.size();
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    if (column > sign.size() && column + 1 + word.size() > kCommentColumns) {
      lines.append("\n").append(sign).append("  ");
      column = sign.size() + 2;
    } else if (at > 0) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
    at = end + 1;
  }
  return lines + "\n";
}

}  // namespace lacuna
