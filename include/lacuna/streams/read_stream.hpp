// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/run_context.hpp"
#include "lacuna/data/roles.hpp"
#include "lacuna/streams/record_stream.hpp"

namespace lacuna {

/// Opens NumPy arrays (.npy, paths or patterns) as records that are read in pieces: one pass
/// over the files checks them and finds where records end, as split_records() does; what is
/// kept is the excerpt.
/// @throws FileError, DataError as read_dataset() does; DataError for other kinds of files and
///   for files whose columns are not those of the first.
RecordStream read_stream(const std::vector<std::string>& paths, const ColumnRoles& roles = {},
                         const RunContext& context = {});

}  // namespace lacuna
