// SPDX-License-Identifier: MIT
// Records that are no arrays on the disk become temporary ones, without being held in memory.
#pragma once

#include <filesystem>

#include "data/formats/row_blocks.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "npy_file.hpp"

namespace lacuna {

/// Opens a file of any kind as rows on the disk: a .npy as it is; of a text, packed or not, of
/// an HDF5 file and of what comes through a pipe the rows are written to a temporary file in
/// $TMPDIR, in one pass, which has no name and is gone with what is returned. Messages name the
/// file that was given, and its lines.
/// @param memory that the pass may take, in bytes.
/// @param find the time, which is counted from its first value where doubles do not hold it.
/// @throws FileError, DataError as read_table(); FileError naming the folder, what is needed
///   and what to do where it has no room; DataError for kinds that cannot be read in blocks.
NpyFile open_rows(const std::filesystem::path& path, std::size_t memory,
                  const RunContext& context, const TimeFinder& find = no_time);

/// The rows in a temporary file.
NpyFile spooled(RowBlocks& blocks, const RunContext& context);

/// A .npy that is packed or comes through a pipe, as a temporary file.
NpyFile unpacked(OpenedFile& file, const RunContext& context);

}  // namespace lacuna
