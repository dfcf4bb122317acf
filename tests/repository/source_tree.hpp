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

/// The layer of a source: "linear" for include/lacuna/linear/... and src/linear/..., "solvers"
/// for solvers/...
inline std::string layer_of(const std::filesystem::path& path) {
  std::vector<std::string> parts;
  for (const auto& part : path) parts.push_back(part.string());
  if (parts[0] == "include") return parts[2];
  return parts[0] == "src" ? parts[1] : parts[0];
}

}  // namespace lacuna::repository
