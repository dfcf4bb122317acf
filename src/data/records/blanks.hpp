// SPDX-License-Identifier: MIT
// Blank cells of states.
#pragma once

#include <optional>
#include <vector>

#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// A table whose blank cells in some columns have a value, and which these were.
struct FilledTable {
  Table table;
  Matrix marks;  ///< rows x columns that were filled (Mark); 0 x 0 where nothing was blank
};

/// Fills blank cells of columns along the straight line between the values before and behind
/// them, at the ends with the nearest. A column without any value stays as it is.
FilledTable fill_blanks(Table table, const std::vector<Index>& columns);

/// The rows in which all of these columns have a value, where each of them stands alone between
/// rows that lack some: channels with rates of their own. Cutting the record there would leave
/// nothing. @return nothing where two such rows follow one another, or there are fewer than 4.
std::optional<Table> common_rows(const Table& table, const std::vector<Index>& columns);

/// Where no two rows that follow one another are complete, as channels have times of their own:
/// the rows of the column that has most values, between the first and the last at which all have
/// some; the others have what the cubic through their nearest values has there.
/// @param time column of it. @return nothing where a column has fewer than 8 values, or the time
/// does not increase from row to row.
std::optional<Table> rows_of_densest(const Table& table, Index time,
                                     const std::vector<Index>& columns);

}  // namespace lacuna
