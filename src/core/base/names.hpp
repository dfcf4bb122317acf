// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lacuna {

/// Whether a text is an identifier: a letter or underscore, then letters, digits, underscores
/// (ASCII, whatever the locale).
bool is_identifier(std::string_view text) noexcept;

/// Whether a name is a word of the expression language (`sin`, `pi`, `t`, ...), so that no
/// state and no input can have it.
bool is_reserved_name(std::string_view name) noexcept;

// What a name, a unit and a line of comment may be is decided here, for every reader and every
// constructor. Readers say where; what comes in from headers of records is cleaned instead.

/// Longest name and longest unit, in bytes.
inline constexpr std::size_t kLongestName = 255;

/// What is wrong with a text, and what to do about it.
struct TextFault {
  std::string problem;
  std::string remedy;
  std::size_t at = 0;  ///< byte where it is wrong
};

/// Why a text cannot be the name of a state, an input, a parameter or an output: it is no
/// identifier, a word of the formula language or longer than kLongestName. Nothing where it
/// can.
std::optional<TextFault> name_fault(std::string_view name);

/// Why a text cannot be a unit; nothing where it can, as the empty one.
///
/// A unit is one line of letters that have no marks to be composed with (Latin, Greek,
/// Cyrillic, Chinese, Japanese, Korean), digits and signs, without square brackets, without
/// blanks at its ends, at most kLongestName bytes long. Such a text is composed (NFC) whatever
/// the order of its characters, is read in one direction, and is what it looks like.
std::optional<TextFault> unit_fault(std::string_view unit);

/// Why a text cannot be lines of comment: it is not UTF-8, or has a character that is not seen,
/// but for tabs and line feeds. Nothing where it can. Comments are not kept, so their length is
/// their author's affair.
std::optional<TextFault> comment_fault(std::string_view text);

/// The unit that is meant by a text in UTF-8 from elsewhere: unseen characters are left out,
/// those that have another shape get it (the ohm sign is an omega, brackets are round),
/// others that no unit has become '?', and what is too long is cut. unit_fault() of it is
/// nothing.
std::string cleaned_unit(std::string_view text);

}  // namespace lacuna
