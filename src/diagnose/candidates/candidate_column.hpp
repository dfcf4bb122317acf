// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lacuna/forms/candidate/effect.hpp"
#include "trajectories/smoother/innovation_system.hpp"

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

/// A candidate with numbers for its shape parameters. The candidate must outlive it.
struct Probe {
  const Candidate* candidate;
  Vector shapes;
};

/// What candidates with coefficient 1 do to the whitened innovations. They do nothing while a
/// delayed value lies before the record.
struct ProbeColumns {
  Matrix columns;            ///< one for each probe; 0 where it is not finite
  std::vector<bool> finite;  ///< whether the form is finite everywhere on the records
};

/// Columns of probes that are all in the same place and equation.
ProbeColumns probe_columns(std::span<const Probe> probes, const Assimilation& assimilation,
                           const InnovationSystem& system);

/// The column of one candidate; nothing when its form is not finite everywhere on the records.
std::optional<Vector> candidate_column(const Candidate& candidate,
                                       std::span<const double> shapes,
                                       const Assimilation& assimilation,
                                       const InnovationSystem& system);

}  // namespace lacuna
