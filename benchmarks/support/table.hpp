// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lacuna::benchmarks {

/// A table of text cells that is written as CSV and as Markdown.
struct ResultTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;

  std::string csv() const;
  std::string markdown() const;
};

/// Writes NAME.csv and NAME.md, each whole or not at all; the folder is made where it is
/// missing.
/// @throws FileError when they cannot be written.
void write_results(const std::filesystem::path& folder, const std::string& name,
                   const std::string& csv, const std::string& markdown);

/// Writes NAME.md, whole or not at all, and prints it; the folder is made where it is missing.
/// @throws FileError when it cannot be written.
void write_page(const std::filesystem::path& folder, const std::string& name,
                const std::string& text);

/// "Intel(R) ..., 2 cores, g++ 12.2.0": the machine and compiler a table was made with.
std::string machine_description();

/// Today as "2026-01-31".
std::string today();

/// Runs gnuplot on a script in its own folder.
/// @return whether a picture was made; false where gnuplot is not installed or the script
/// fails.
bool render_with_gnuplot(const std::filesystem::path& script);

}  // namespace lacuna::benchmarks
