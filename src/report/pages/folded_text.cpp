// SPDX-License-Identifier: MIT
#include "folded_text.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/base/utf8.hpp"

namespace lacuna {
namespace {

/// Columns of a text: one for each character, none for "\x1b[1m".
std::size_t columns_of(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size();) {
    if (text.substr(at, 2) == "\x1b[") {
      at = std::min(text.find('m', at), text.size() - 1) + 1;
      continue;
    }
    at += std::max<std::size_t>(1, utf8_length(text, at));
    ++count;
  }
  return count;
}

/// Whether a line may end behind the word, so that the other begins the next one.
bool may_break(std::string_view word, std::string_view next) {
  for (const std::string_view sign : {"+", "-", "+-", "="})
    if (word == sign) return false;
  return next != "+-" && next != "%";
}

/// Pieces that stay together, each with the blanks in front of it.
std::vector<std::string_view> pieces_of(std::string_view line) {
  std::vector<std::string_view> pieces;
  std::size_t begin = 0, word = line.find_first_not_of(' ');
  while (word != std::string_view::npos) {
    const std::size_t end = std::min(line.find(' ', word), line.size());
    const std::size_t next = line.find_first_not_of(' ', end);
    const std::string_view following =
        next == std::string_view::npos
            ? std::string_view()
            : line.substr(next, std::min(line.find(' ', next), line.size()) - next);
    if (following.empty() || may_break(line.substr(word, end - word), following)) {
      pieces.push_back(line.substr(begin, end - begin));
      begin = end;
    }
    word = next;
  }
  return pieces;
}

/// Blanks in front of what continues a line.
std::size_t hanging(std::string_view line) {
  const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
  return blanks == 0 ? 2 : blanks + 4;
}

}  // namespace

std::string folded_line(std::string_view line, std::size_t columns, std::size_t indent) {
  if (columns_of(line) <= columns) return std::string(line);
  std::string text;
  std::size_t used = 0;
  for (std::string_view piece : pieces_of(line)) {
    if (used > 0 && used + columns_of(piece) > columns) {
      piece.remove_prefix(std::min(piece.find_first_not_of(' '), piece.size()));
      text += "\n" + std::string(indent, ' ');
      used = indent;
    }
    text += piece;
    used += columns_of(piece);
  }
  return text;
}

std::string folded(const std::string& text, std::size_t columns) {
  std::string result;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end);
    result += folded_line(line, columns, hanging(line));
    if (end == std::string_view::npos) break;
    result += '\n';
    rest.remove_prefix(end + 1);
  }
  return result;
}

}  // namespace lacuna
