// SPDX-License-Identifier: MIT
// Pages, and the blocks of code in them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace lacuna::testing {

/// A block of code of a page: what stands behind ``` and its lines.
struct Block {
  std::string kind;
  std::vector<std::string> lines;
};

/// A page by its path in the repository.
struct PageText {
  std::string path;
  std::vector<Block> blocks;
  std::vector<std::string> prose;  ///< the lines outside of blocks
};

/// The words of a text with one blank between them.
inline std::string plain(const std::string& text) {
  std::istringstream words(text);
  std::string result;
  for (std::string word; words >> word;) result += (result.empty() ? "" : " ") + word;
  return result;
}

inline void PrintTo(const PageText& page, std::ostream* out) { *out << page.path; }

inline PageText read_page(const std::string& path) {
  std::ifstream file(std::filesystem::path(LACUNA_SOURCE_DIR) / path);
  PageText page{path, {}, {}};
  bool open = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("```", 0) == 0) {
      open = !open;
      if (open) page.blocks.push_back({line.substr(3), {}});
    } else {
      (open ? page.blocks.back().lines : page.prose).push_back(line);
    }
  }
  return page;
}

/// Every page that somebody writes, ordered by path: results of studies are written by programs.
/// Not the record of changes.
inline std::vector<PageText> all_pages() {
  const std::filesystem::path root = LACUNA_SOURCE_DIR;
  std::vector<std::string> paths{"README.md", "CONTRIBUTING.md"};
  for (const char* folder : {"docs", "site", "examples", "effects", "bases", "solvers", "data",
                             "python", "benchmarks", "tests"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".md" &&
          entry.path().parent_path().filename() != "results")
        paths.push_back(std::filesystem::relative(entry.path(), root).string());
  std::sort(paths.begin(), paths.end());
  std::vector<PageText> pages;
  for (const std::string& path : paths) pages.push_back(read_page(path));
  return pages;
}

/// The lines of a block as a shell reads them, without comments; those with a \ at the end are
/// joined with the next. None of a block of another kind.
inline std::vector<std::string> shell_lines(const Block& block) {
  std::vector<std::string> lines;
  if (block.kind != "sh") return lines;
  bool goes_on = false;
  for (const std::string& line : block.lines) {
    if (goes_on)
      lines.back() += " " + plain(line);
    else if (!plain(line).empty() && plain(line).front() != '#')
      lines.push_back(plain(line));
    goes_on = !line.empty() && line.back() == '\\';
    if (goes_on) lines.back().pop_back();
  }
  return lines;
}

/// Whether a command shows how one is written, with parts to be left out or words to be replaced,
/// as in `lacuna fit MODEL DATA... [--profile]`.
inline bool is_synopsis(const std::string& command) {
  std::istringstream words(command.substr(0, command.find(" # ")));
  for (std::string word; words >> word;) {
    if (word.front() == '[') return true;
    const std::size_t other = word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ|");
    const std::size_t end = std::min(other, word.size());
    const std::string rest = word.substr(end);
    if (end >= 2 && (rest.empty() || rest == "...")) return true;
  }
  return false;
}

}  // namespace lacuna::testing
