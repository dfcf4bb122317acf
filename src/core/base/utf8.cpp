// SPDX-License-Identifier: MIT
#include "utf8.hpp"

namespace lacuna {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// Bytes that a first byte announces; 0 when it is none.
std::size_t announced_length(unsigned first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return 2;
  if (first >= 0xE0 && first <= 0xEF) return 3;
  return first >= 0xF0 && first <= 0xF4 ? 4 : 0;
}

/// Range of the second byte, which excludes overlong forms, surrogates and what is too large.
bool is_second(unsigned first, unsigned second) {
  if (first == 0xE0) return second >= 0xA0 && second <= 0xBF;
  if (first == 0xED) return second >= 0x80 && second <= 0x9F;
  if (first == 0xF0) return second >= 0x90 && second <= 0xBF;
  if (first == 0xF4) return second >= 0x80 && second <= 0x8F;
  return second >= 0x80 && second <= 0xBF;
}

constexpr bool is_in(char32_t first, char32_t character, char32_t last) noexcept {
  return first <= character && character <= last;
}

void append_digits(std::string& text, unsigned value, unsigned digits) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  while (digits-- > 0) text += kDigits[(value >> (4U * digits)) & 0xFU];
}

/// "\x1b" for each byte of a control or of what is not UTF-8, "\u202e" for other characters.
void append_visible(std::string& text, std::string_view character) {
  if (character.size() > 2) {
    const char32_t code = code_point(character, 0);
    text += "\\u";
    append_digits(text, static_cast<unsigned>(code), code > 0xFFFF ? 6 : 4);
    return;
  }
  for (std::size_t i = 0; i < character.size(); ++i) {
    text += "\\x";
    append_digits(text, byte_at(character, i), 2);
  }
}

}  // namespace

std::size_t utf8_length(std::string_view text, std::size_t at) {
  const std::size_t length = announced_length(byte_at(text, at));
  if (length < 2) return length;
  if (at + length > text.size() || !is_second(byte_at(text, at), byte_at(text, at + 1)))
    return 0;
  for (std::size_t i = 2; i < length; ++i)
    if ((byte_at(text, at + i) & 0xC0U) != 0x80U) return 0;
  return length;
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    if (length == 0) return false;
    i += length;
  }
  return true;
}

char32_t code_point(std::string_view text, std::size_t at) {
  const std::size_t length = utf8_length(text, at);
  if (length < 2) return byte_at(text, at);
  char32_t code = byte_at(text, at) & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) code = code << 6U | (byte_at(text, at + i) & 0x3FU);
  return code;
}

std::string utf8_of(char32_t character) {
  const auto byte = [&](unsigned shift, unsigned mark, unsigned mask) {
    return static_cast<char>(mark | ((character >> shift) & mask));
  };
  if (character < 0x80) return {byte(0, 0, 0x7F)};
  if (character < 0x800) return {byte(6, 0xC0, 0x1F), byte(0, 0x80, 0x3F)};
  if (character < 0x10000)
    return {byte(12, 0xE0, 0x0F), byte(6, 0x80, 0x3F), byte(0, 0x80, 0x3F)};
  return {byte(18, 0xF0, 0x07), byte(12, 0x80, 0x3F), byte(6, 0x80, 0x3F), byte(0, 0x80, 0x3F)};
}

// The format characters of Unicode (Cf) that stand in texts of any script, line separators, and
// the fillers of Hangul.
bool is_unseen(char32_t c) noexcept {
  return c < 0x20 || is_in(0x7F, c, 0x9F) || c == 0xAD || c == 0x61C || c == 0x115F ||
         c == 0x1160 || c == 0x180E || is_in(0x200B, c, 0x200F) || is_in(0x2028, c, 0x202E) ||
         is_in(0x2060, c, 0x206F) || c == 0x3164 || c == 0xFEFF || c == 0xFFA0 ||
         is_in(0xFFF9, c, 0xFFFB) || is_in(0xE0000, c, 0xE007F);
}

std::string to_utf8(std::string_view text) {
  if (is_utf8(text)) return std::string(text);
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned byte = byte_at(text, i);
    if (byte >= 0x80) result += static_cast<char>(0xC0U | (byte >> 6U));
    result += static_cast<char>(byte < 0x80 ? byte : 0x80U | (byte & 0x3FU));
  }
  return result;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const std::string_view character = text.substr(i, length == 0 ? 1 : length);
    const bool layout = character == "\n" || character == "\t";
    if (length > 0 && (layout || !is_unseen(code_point(text, i))))
      result += character;
    else
      append_visible(result, character);
    i += character.size();
  }
  return result;
}

}  // namespace lacuna
