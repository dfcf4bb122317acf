// SPDX-License-Identifier: MIT
#include "near_file.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

namespace fs = std::filesystem;

/// Names of what is no folder in a folder, in order; none where it cannot be listed.
std::vector<std::string> files_of(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code unknown;
    if (!entry->is_directory(unknown)) names.push_back(entry->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string remedy_of_missing(const fs::path& path, const std::string& otherwise) {
  std::error_code unknown;
  if (path.filename().empty() || fs::exists(fs::symlink_status(path, unknown))) return otherwise;
  const auto near = nearest_name(path.filename().string(), files_of(path.parent_path()));
  return near ? "did you mean '" + (path.parent_path() / *near).string() + "'?" : otherwise;
}

}  // namespace lacuna
