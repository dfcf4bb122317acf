// SPDX-License-Identifier: MIT
// Logs of one run that were written by several devices.
#pragma once

#include <string>
#include <vector>

#include "data/times/counted_times.hpp"
#include "lacuna/data/records/roles.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// Finds the time of a file that is joined with others; roles may name columns of these.
TimeFinder time_finder_of_part(const ColumnRoles& roles);

/// Tables of one run as one with Table::own_times: a row for each time of any of them, the times in
/// the unit of the first that says one, which the others take where they say none (a note).
/// Clocks and counted times are brought to the begin of the first table. Times that are less
/// than a thousandth of a step apart are the same.
/// @param roles time and its unit.
/// @throws DataError where a name stands in two tables, times go backwards, are not of one kind
///   or have none in common, their units do not convert, or records are numbered; ConfigError
///   where a step is given in the place of times.
Table joined_on_time(std::vector<Table> tables, const ColumnRoles& roles);

}  // namespace lacuna
