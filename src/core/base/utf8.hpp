// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lacuna {

/// Bytes of the UTF-8 character that begins at `at`; 0 where none does (RFC 3629: no overlong
/// forms, no surrogates, nothing above U+10FFFF).
std::size_t utf8_length(std::string_view text, std::size_t at);

/// Whether the text is UTF-8 from end to end.
bool is_utf8(std::string_view text);

/// The text as UTF-8: what is not UTF-8 is read as Latin-1 (ISO 8859-1), byte by byte.
std::string to_utf8(std::string_view text);

/// The character that begins at `at`. @pre utf8_length() there is not 0.
char32_t code_point(std::string_view text, std::size_t at);

/// A character as UTF-8.
std::string utf8_of(char32_t character);

/// Whether a character has no picture of its own but acts on the text around it: controls (C0,
/// DEL, C1), separators of lines and paragraphs, marks of direction, characters of no width,
/// tags. Such a text looks otherwise than it is read.
bool is_unseen(char32_t character) noexcept;

/// The text with what a terminal would act on made visible: unseen characters other than line
/// feed and tab, and bytes that are not UTF-8, become "\x1b" or "\u202e" in letters.
std::string printable(std::string_view text);

}  // namespace lacuna
