// SPDX-License-Identifier: MIT
// What further slaves along a record show.
#pragma once

#include <vector>

#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "slave.hpp"

namespace lacuna {

/// See SyncResult::response. The noise is drawn by the seed of the context.
Vector response_to_noise(const SlaveTask& task, const Dataset& record,
                         const SyncResult& result);

/// See SyncResult::start_response.
Vector response_to_start(const SlaveTask& task, const Dataset& record,
                         const SyncResult& result);

/// See SyncResult::conditional_exponent.
double conditional_exponent(const SlaveTask& task, const Trajectory& record,
                            const SyncResult& result);

/// See SyncResult::step_errors; of an integrator with fixed steps.
std::vector<Matrix> step_errors(const SlaveTask& task, const Dataset& record,
                                const SyncResult& result);

/// Whether a slave by steps as long as the record's diverges (Rk4), or cannot go on.
bool is_faster_than_samples(const SlaveTask& task, const Dataset& record);

}  // namespace lacuna
