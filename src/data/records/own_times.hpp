// SPDX-License-Identifier: MIT
// Channels that have times of their own, brought to the same ones.
#pragma once

#include <optional>
#include <vector>

#include "lacuna/data/records/roles.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// One channel at other times than its own: as it goes on between its samples.
/// @param time its n >= 1 own times, increasing. @param values n.
/// @param queries NaN comes out where the channel has no samples around: before its first one,
///   behind its last one (of a held channel a step behind it), and in gaps of its own sampling
///   (gap_threshold()).
Vector channel_at(const Vector& time, const Vector& values, Interpolation interpolation,
                  const Eigen::Ref<const Vector>& queries);

/// A table whose channels have times of their own (Table::own_times) with the inputs at all times:
/// each goes on between its samples as ColumnRoles::holds says, else as its own samples show
/// (shows_hold()), else smoothly.
Table with_inputs_everywhere(Table table, const ColumnIndices& columns,
                             const ColumnRoles& roles);

/// The rows of the channel of states or derivatives that has most samples; the others have
/// there what channel_at() gives, by cubics where nobody says how they go on. A note says it.
Table at_times_of_densest(const Table& table, const ColumnIndices& columns,
                          const ColumnRoles& roles);

}  // namespace lacuna
