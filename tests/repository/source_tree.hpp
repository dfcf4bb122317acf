// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace lacuna::repository {

/// A source file of the project: its path from the root and its lines.
struct SourceFile {
  std::filesystem::path path;
  std::vector<std::string> lines;
};

inline std::vector<std::string> read_lines(const std::filesystem::path& path) {
  std::ifstream stream(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// All .hpp and .cpp files below a folder of the source tree, ordered by path.
inline std::vector<SourceFile> sources_below(const std::string& folder) {
  const std::filesystem::path root = LACUNA_SOURCE_DIR;
  std::vector<SourceFile> files;
  if (!std::filesystem::exists(root / folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
    const auto extension = entry.path().extension();
    if (!entry.is_regular_file() || (extension != ".hpp" && extension != ".cpp")) continue;
    files.push_back({std::filesystem::relative(entry.path(), root), read_lines(entry.path())});
  }
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

/// The files of several folders.
inline std::vector<SourceFile> sources_below(const std::vector<std::string>& folders) {
  std::vector<SourceFile> all;
  for (const std::string& folder : folders) {
    auto files = sources_below(folder);
    all.insert(all.end(), files.begin(), files.end());
  }
  return all;
}

/// Names from the root to the file: "src", "model", "files", "ode_text.cpp".
inline std::vector<std::string> parts_of(const std::filesystem::path& path) {
  std::vector<std::string> parts;
  for (const auto& part : path) parts.push_back(part.string());
  return parts;
}

/// Where a source or header stands in the library: "model/files" for src/model/files/... and
/// include/lacuna/model/files/..., "solvers" for solvers/... and include/lacuna/solvers/...
inline std::string folder_of(const std::filesystem::path& path) {
  std::vector<std::string> parts = parts_of(path);
  if (parts[0] == "include") parts.erase(parts.begin(), parts.begin() + 2);
  if (parts[0] == "src") parts.erase(parts.begin());
  const bool is_shelf = parts[0] == "bases" || parts[0] == "solvers" || parts[0] == "effects";
  return is_shelf || parts.size() < 3 ? parts[0] : parts[0] + "/" + parts[1];
}

/// The wing of a source: "model" for what is in src/model/... and include/lacuna/model/...; what
/// stands on a shelf belongs to the wing whose plug point it fills.
inline std::string wing_of(const std::filesystem::path& path) {
  const std::string folder = folder_of(path), first = folder.substr(0, folder.find('/'));
  if (first == "bases" || first == "solvers") return "regression";
  return first == "effects" ? "forms" : first;
}

}  // namespace lacuna::repository
