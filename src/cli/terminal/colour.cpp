// SPDX-License-Identifier: MIT
#include "colour.hpp"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <iostream>
#include <string_view>

namespace lacuna::cli {
namespace {

constexpr std::string_view kBold = "\x1b[1m", kGreen = "\x1b[1;32m", kYellow = "\x1b[1;33m",
                           kRed = "\x1b[1;31m", kPlain = "\x1b[0m";

struct VerdictColour {
  std::string_view begin, colour;
};

/// How the sentences of verdicts begin; the first that fits counts.
constexpr std::array kVerdicts = {
    VerdictColour{"No discrepancy", kGreen},
    VerdictColour{"Explained but for", kYellow},
    VerdictColour{"Explained", kGreen},
    VerdictColour{"Fits to the noise", kGreen},
    VerdictColour{"Holds up to", kYellow},
    VerdictColour{"Holds", kGreen},
    VerdictColour{"No structure is missing", kYellow},
    VerdictColour{"Partly explained", kYellow},
    VerdictColour{"An approximation", kYellow},
    VerdictColour{"Undecided", kYellow},
    VerdictColour{"Undetermined", kYellow},
    VerdictColour{"Not finished", kYellow},
    VerdictColour{"Something is missing", kRed},
    VerdictColour{"No effect is sought", kRed},
    VerdictColour{"Does not hold", kRed},
    VerdictColour{"Wrong library", kRed},
};

std::string painted(std::string_view line, std::size_t length, std::string_view colour) {
  std::string text(colour);
  text.append(line.substr(0, length)).append(kPlain);
  return text.append(line.substr(length));
}

/// Where the first colon, comma, semicolon or full stop is that ends a phrase; none in a
/// number.
std::size_t end_of_phrase(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i)
    if (std::string_view(":,;.").find(line[i]) != std::string_view::npos &&
        (i + 1 == line.size() || line[i + 1] == ' '))
      return i;
  return line.size();
}

/// @param next the line below.
std::string coloured_line(std::string_view line, std::string_view next) {
  for (const auto& [begin, colour] : kVerdicts)
    if (line.starts_with(begin)) return painted(line, end_of_phrase(line), colour);
  const bool is_heading = !line.empty() && line.front() != ' ' && line.back() != '.';
  if (is_heading && next.starts_with("  ")) return painted(line, line.size(), kBold);
  return std::string(line);
}

}  // namespace

bool shows_colour(const std::ostream& out) {
  const char* terminal = std::getenv("TERM");
  return &out == &std::cout && isatty(STDOUT_FILENO) != 0 &&
         std::getenv("NO_COLOR") == nullptr && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

std::string coloured(const std::string& text) {
  std::string result;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    result += coloured_line(line, rest);
    if (end != std::string_view::npos) result += '\n';
  }
  return result;
}

}  // namespace lacuna::cli
