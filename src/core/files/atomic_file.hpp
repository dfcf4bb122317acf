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

/// Tries, without leaving anything, what write_file_atomically() needs, but for the space.
/// @throws FileError as that.
void check_writable(const std::filesystem::path& path);

/// The file that writing to a path makes or replaces: behind its symbolic links, there or not
/// yet.
/// @throws FileError when they lead in a circle.
std::filesystem::path written_file(const std::filesystem::path& path);

/// A pipe or a device (/dev/stdout): it has no content that could be replaced.
bool is_stream(const std::filesystem::path& path);

/// A lock that is free while no file is being written. Who holds it may end the process at
/// once: no temporary file is left behind.
/// @return a lock that owns nothing where a file is being written.
std::unique_lock<std::mutex> try_to_hold_files();

}  // namespace lacuna
