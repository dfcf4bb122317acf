// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lacuna/discrepancy/candidate.hpp"
#include "lacuna/innovation/innovation_system.hpp"

namespace lacuna {

/// Memory states of a candidate along a record: exponential midpoint steps of half a sampling
/// step, which are stable for any rate.
/// @return (2n-1) x number of memory states.
Matrix memory_along(const Candidate& candidate, std::span<const double> shapes,
                    const Variables& variables, const LinearisedRecord& record);

/// Values of a candidate's form along a record, at samples and midpoints (2n-1).
Vector form_along(const Candidate& candidate, std::span<const double> shapes,
                  const Variables& variables, const LinearisedRecord& record);

/// What a candidate with coefficient 1 does to the whitened innovations; nothing when its form
/// is not finite everywhere on the record.
std::optional<Vector> candidate_column(const Candidate& candidate,
                                       std::span<const double> shapes,
                                       const Assimilation& assimilation,
                                       const InnovationSystem& system);

}  // namespace lacuna
