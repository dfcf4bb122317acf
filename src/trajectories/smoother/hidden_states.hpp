// SPDX-License-Identifier: MIT
// States that no column of the records shows.
#pragma once

#include <vector>

#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// States of a model that nobody measured and that are no derivative of a measured one by an
/// identity (dq/dt = v). m entries, or none where there is no such state.
std::vector<bool> hidden_states(const OdeModel& model, const Dataset& data);

/// The numbers of those that are marked.
std::vector<Index> places_of(const std::vector<bool>& marks);

/// Records with a path for their hidden states, from which an estimation may start: the model's
/// equations integrated from sample to sample, each step from the measured states as they are
/// and from where the hidden ones have come.
/// @param hidden as hidden_states() has it; none: the records as they are.
/// @param begin m entries: where hidden states begin.
Dataset with_hidden_paths(const OdeModel& model, Dataset data, const std::vector<bool>& hidden,
                          const Vector& begin);

/// Records whose hidden states are taken from paths, per record n x (m or more).
Dataset with_paths_of(Dataset data, const std::vector<bool>& hidden,
                      const std::vector<Matrix>& paths);

/// Where hidden states may begin: at `first`, and a range of the path from there above and
/// below it, one state at a time, and all at once (levels and concentrations are all positive).
/// @param data records with the path from `first`.
std::vector<Vector> hidden_begins(const Dataset& data, const std::vector<bool>& hidden,
                                  const Vector& first);

/// assimilate(), where states are hidden (AssimilationOptions::hidden) from several starts of
/// their path: the largest likelihood is taken.
Assimilation assimilate_from_starts(const OdeModel& model, const Dataset& data,
                                    const std::vector<Matrix>& omitted,
                                    const AssimilationOptions& options,
                                    const RunContext& context);

}  // namespace lacuna
