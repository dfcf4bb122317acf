// SPDX-License-Identifier: MIT
// Channels of a text that have columns of times of their own: "Time;x;Time;y".
#pragma once

#include <vector>

#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// Whether each further clock shows the time of the first one, or nothing, in every row.
/// @param clocks columns of times, ascending; each belongs to the columns behind it.
bool are_one_clock(const Table& table, const std::vector<Index>& clocks);

/// The table with the first clock alone: a row for each time of any channel, in which the
/// channels that have no sample then are missing. Where all clocks are one the rows stay.
/// Samples without a time, and those at the time of the one before, are left out.
/// @throws DataError where the time of a channel goes backwards.
Table with_one_clock(const Table& table, const std::vector<Index>& clocks);

/// The columns without those of further clocks.
Table without_further_clocks(Table table, const std::vector<Index>& clocks);

}  // namespace lacuna
