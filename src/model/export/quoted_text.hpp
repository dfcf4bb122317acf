// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace lacuna {

/// A text of somebody else's (a unit, a name as the model has it) as it may stand in a comment
/// or in a string of any language: ASCII without anything that ends, continues or begins a
/// comment, a string, a directive, an escape or a line there. What is not a letter, a digit, a
/// blank or one of _.,()+-%*/^ becomes "<U+00B0>", a byte that is not UTF-8 "<0xB0>", and so
/// does the second of two marks that mean something together. What is longer than 100
/// characters is cut off: "...".
std::string quoted_text(std::string_view text);

/// Comment lines of at most 92 columns where blanks allow it, those behind the first indented.
/// @param sign what begins a comment: "// ". @param text of quoted_text() pieces.
std::string comment_lines(std::string_view sign, std::string_view text);

}  // namespace lacuna
