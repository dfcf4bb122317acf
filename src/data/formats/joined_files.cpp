// SPDX-License-Identifier: MIT
#include "data/formats/joined_files.hpp"

#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "file_kinds.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

bool is_there(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// Files whose names begin a text and are followed by its end or a `+`: those that are there,
/// the longest first; then those with a sheet and patterns, the shortest first.
std::vector<std::string> first_files(const std::string& text) {
  std::vector<std::string> plain, others;
  for (std::size_t end = text.find('+');; end = text.find('+', end + 1)) {
    std::string file = text.substr(0, end);
    if (is_there(file))
      plain.insert(plain.begin(), std::move(file));
    else if (file_and_sheet(file).sheet || !files_that_match(file).empty())
      others.push_back(std::move(file));
    if (end == std::string::npos) break;
  }
  plain.insert(plain.end(), others.begin(), others.end());
  return plain;
}

/// The text as names of files that are there; nothing where it is not.
std::optional<std::vector<std::string>> all_files(const std::string& text) {
  for (const std::string& file : first_files(text)) {
    if (file.size() == text.size()) return std::vector<std::string>{file};
    if (auto rest = all_files(text.substr(file.size() + 1))) {
      rest->insert(rest->begin(), file);
      return rest;
    }
  }
  return std::nullopt;
}

/// A name for the pattern of one file.
std::string named(const std::string& file) {
  const std::vector<std::string> files = files_that_match(file);
  if (files.size() > 1)
    throw DataError(file, "the pattern matches " + std::to_string(files.size()) + " files",
                    "join one file with one (FIRST+SECOND)");
  return files.empty() ? file : files.front();
}

}  // namespace

std::vector<std::string> files_that_match(const std::string& pattern) {
  if (pattern.find_first_of("*?[") == std::string::npos || is_there(pattern)) return {};
  glob_t found{};
  const std::unique_ptr<glob_t, decltype(&globfree)> guard(&found, &globfree);
  if (glob(pattern.c_str(), 0, nullptr, &found) != 0) return {};
  return {found.gl_pathv, found.gl_pathv + found.gl_pathc};
}

std::vector<std::string> joined_files(const std::string& path) {
  // More signs are no names of files, and all ways to cut them would be tried.
  constexpr std::ptrdiff_t kMost = 8;
  const auto signs = std::count(path.begin(), path.end(), '+');
  if (signs == 0 || signs > kMost || is_there(path)) return {path};
  std::optional<std::vector<std::string>> files = all_files(path);
  if (!files) {
    // One of two names may be misspelt, which is said when it is read.
    const std::size_t first = path.find('+'), last = path.rfind('+');
    if (first_files(path).empty() && first_files(path.substr(last + 1)).empty()) return {path};
    files = std::vector<std::string>{};
    for (std::size_t begin = 0, end = first; begin <= path.size();
         begin = end + 1, end = std::min(path.find('+', begin), path.size()))
      files->push_back(path.substr(begin, end - begin));
  }
  for (std::string& file : *files) file = named(file);
  return *files;
}

}  // namespace lacuna
