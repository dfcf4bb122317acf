// SPDX-License-Identifier: MIT
// Blank cells of states.
#pragma once

#include <vector>

#include "lacuna/data/table.hpp"

namespace lacuna {

/// A table whose blank cells in some columns have a value, and which these were.
struct FilledTable {
  Table table;
  Matrix marks;  ///< rows x columns that were filled (Mark); 0 x 0 where nothing was blank
};

/// Fills blank cells of columns along the straight line between the values before and behind
/// them, at the ends with the nearest. A column without any value stays as it is.
FilledTable fill_blanks(Table table, const std::vector<Index>& columns);

}  // namespace lacuna
