// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <mutex>
#include <string_view>

namespace lacuna {

/// Writes a file whole or not at all: a temporary file in the same folder, then a rename.
/// @throws FileError naming the path when it cannot be written; an existing file stays as it
/// was.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// A lock that is free while no file is being written. Who holds it may end the process at
/// once: no temporary file is left behind.
/// @return a lock that owns nothing where a file is being written.
std::unique_lock<std::mutex> try_to_hold_files();

}  // namespace lacuna
