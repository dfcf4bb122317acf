// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/data/records/roles.hpp"

namespace lacuna {

/// The table without rows that have the time, and the number of the record, of the row before
/// them, which is noted. Nothing where there is no such row, or where there are many: then the
/// time is too coarse, or another column is the time.
std::optional<Table> without_repeated_times(const Table& table, const ColumnIndices& columns);

}  // namespace lacuna
