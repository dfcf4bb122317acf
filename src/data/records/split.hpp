// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/roles.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// The uninterrupted records of a table.
struct Records {
  std::vector<TableRows> ranges;   ///< at least two rows each
  std::vector<std::string> notes;  ///< where and why it was split; at most about a dozen
};

/// The time step above which a record is taken to have a gap, from the steps between its rows.
///
/// With the 10 % and 80 % quantiles q10, q80 of the steps: 1.5 times the median when
/// q80 <= 1.1 q10 (uniform sampling); 5 q80 when q80 <= 3 q10 (sampling with jitter); nothing
/// otherwise or for fewer than 4 steps, as a record sampled at will has no usual step.
std::optional<double> gap_threshold(std::vector<double> steps);

/// Cuts a table at missing values, at jumps in time (see gap_threshold) and where the number in
/// the trajectory column changes; columns without a role do not count. A row that is left alone
/// between two cuts is dropped, which is noted.
/// @param jumps_stay whether time may jump within a record.
/// @throws DataError naming file, line and column for an infinite value, time that goes
/// backwards
///   or stands still, or when no record of two rows is left.
Records split_records(const Table& table, const ColumnIndices& columns,
                      bool jumps_stay = false);

}  // namespace lacuna
