// SPDX-License-Identifier: MIT
#pragma once

#include "data/records/split.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "npy_file.hpp"

namespace lacuna {

/// The uninterrupted records of a file, as split_records() finds them in its pieces; one pass.
/// What is usual for steps of time is asked of each piece by itself.
/// @throws DataError as split_records().
Records find_records(const NpyFile& file, const ColumnIndices& columns,
                     const RunContext& context);

}  // namespace lacuna
