// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace lacuna {

/// Writes a file whole or not at all: a temporary file in the same folder, then a rename.
/// @throws FileError naming the path when it cannot be written; an existing file stays as it was.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

}  // namespace lacuna
