// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>

namespace lacuna::cli {

/// Whether a stream is the process's standard output on a terminal that shows colour: neither
/// NO_COLOR is set (no-color.org) nor TERM is "dumb".
bool shows_colour(const std::ostream& out);

/// A report with the escape codes of a terminal: the first phrase of a verdict green, yellow or
/// red, headings (no sentence, with an indented line below) bold. Without the codes it is the
/// text as it was.
std::string coloured(const std::string& text);

}  // namespace lacuna::cli
