// SPDX-License-Identifier: MIT
// Identities dq/dt = v that the records contradict: a sensor of v with an offset or a gain.
#pragma once

#include <optional>

#include "lacuna/diagnosis/diagnose.hpp"
#include "lacuna/estimation/assimilation.hpp"

namespace lacuna {

/// The nominal model on the records with those of its identities disturbed like other equations
/// that are significantly so.
/// @param exact the same with all identities exact. @param explained the noise model with which
///   the records are explained so far; where its noise of the measurement is no larger than the
///   records show from sample to sample nothing is contradicted.
/// @return nothing when the identities hold.
std::optional<Assimilation> with_broken_identities(const OdeModel& nominal, const Dataset& data,
                                                   const Assimilation& exact,
                                                   const NoiseModel& explained,
                                                   const DiagnosisOptions& options,
                                                   const RunContext& context);

}  // namespace lacuna
