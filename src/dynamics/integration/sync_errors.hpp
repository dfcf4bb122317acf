// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"

namespace lacuna {

/// max_n |x_m,n| over all trajectories.
double largest_norm(const Dataset& record);

/// Median, mean and relative mean of the errors.
void add_statistics(const Dataset& record, SyncResult& result);

/// Root mean square of what slaves are off paths, of each state over the last three quarters.
Vector late_errors(const std::vector<Matrix>& slaves, const std::vector<Matrix>& paths);

/// See SyncResult::error_over_noise.
std::optional<double> error_over_noise(const Dataset& record, const SyncResult& result);

/// See SyncResult::settled.
bool has_settled(const Dataset& record, const SyncResult& result);

}  // namespace lacuna
