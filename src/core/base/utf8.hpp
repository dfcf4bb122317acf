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

/// The text with what a terminal would act on made visible: control characters other than line
/// feed and tab, and bytes that are not UTF-8, become "\x1b" in letters.
std::string printable(std::string_view text);

}  // namespace lacuna
