// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

/// Columns of a screen on which a text for people has to fit, and its lines.
inline constexpr std::size_t kScreenColumns = 80, kScreenLines = 40;

/// The text in lines of at most so many columns, broken at blanks: what continues a line stands
/// four blanks deeper, two where the line begins at the edge. No break stands behind a sign of an
/// equation, beside "+-" or before "%", and a word longer than a line is left whole. Escape codes
/// of a terminal have no width.
std::string folded(const std::string& text, std::size_t columns = kScreenColumns);

/// Rows under one another, columns as wide as they need, two blanks in front and between.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

/// One line in lines of at most so many columns, each continued behind so many blanks.
std::string folded_line(std::string_view line, std::size_t columns, std::size_t indent);

/// Two names at most: "a.csv", "a.csv, b.csv", "a.csv and 4 more".
std::string briefly(const std::vector<std::string>& names, const std::string& separator = ", ");

/// Sentences that differ only in the place in front of them, once for all places: of "a.csv: the
/// column s is text" and "b.csv: the column s is text" the one "a.csv, b.csv: the column s is
/// text". Each stands where it stood first; one that is there twice stands once.
std::vector<std::string> said_once(const std::vector<std::string>& sentences);

}  // namespace lacuna
