// SPDX-License-Identifier: MIT
#pragma once

#include <regex>
#include <string>
#include <vector>

#include "repository/source_tree.hpp"

namespace lacuna::repository {

/// All .md files below a folder of the source tree, ordered by path.
inline std::vector<SourceFile> pages_below(const std::string& folder) {
  const std::filesystem::path root = LACUNA_SOURCE_DIR;
  std::vector<SourceFile> pages;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
    if (entry.is_regular_file() && entry.path().extension() == ".md")
      pages.push_back(
          {std::filesystem::relative(entry.path(), root), read_lines(entry.path())});
  std::sort(pages.begin(), pages.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return pages;
}

/// The lines of a page without its blocks of code, fenced or indented; these are empty.
inline std::vector<std::string> prose_of(const std::vector<std::string>& lines) {
  std::vector<std::string> prose;
  bool is_fenced = false;
  for (const std::string& line : lines) {
    const bool is_fence = line.rfind("```", 0) == 0;
    is_fenced = is_fenced != is_fence;
    const bool is_code = is_fenced || is_fence || line.rfind("    ", 0) == 0;
    prose.push_back(is_code ? "" : line);
  }
  return prose;
}

/// What the one group of a pattern matches, everywhere in a text.
inline std::vector<std::string> all_matches(const std::string& text,
                                            const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

}  // namespace lacuna::repository
