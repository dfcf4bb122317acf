// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "lacuna/core/base/types.hpp"

namespace lacuna::benchmarks {

/// Identification of a file that is read in pieces beside what reading it through a mapping
/// takes: Lorenz' system with derivatives given, preset `sindy`, on two threads, with the file
/// on the disk and in the cache of the system. Writes the record and pieces.md into a folder.
int run_pieces(const std::filesystem::path& folder, Index rows);

}  // namespace lacuna::benchmarks
