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

/// Time from which on a candidate's form is known along a record: a delayed value lies in the
/// record, a memory has forgotten where it began (two that begin a range of the memory apart
/// have come within a twentieth of it). Nothing when that is never so: a play that never moves.
std::optional<double> known_from(const Candidate& candidate, std::span<const double> shapes,
                                 const Variables& variables, const LinearisedRecord& record);

/// What a candidate with coefficient 1 does to the whitened innovations; nothing when its form
/// is not finite everywhere on the record. It does nothing while a delayed value lies before
/// the record.
std::optional<Vector> candidate_column(const Candidate& candidate,
                                       std::span<const double> shapes,
                                       const Assimilation& assimilation,
                                       const InnovationSystem& system);

}  // namespace lacuna
