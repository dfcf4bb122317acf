// SPDX-License-Identifier: MIT
// The plain structure of records that nothing fits to the noise.
#pragma once

#include <optional>

#include "identify/free_runs/free_run.hpp"
#include "lacuna/model/equations/term.hpp"

namespace lacuna {

/// Stretches of a few mean periods of records without inputs, each with a beginning of its own:
/// a run that lacks damping, or has another frequency, is out of phase after more. Records with
/// inputs as they are.
Dataset in_stretches(const Dataset& data);

/// A structure whose terms are all worth it in free runs (is_worth()), found by a search by
/// single terms. It begins at the affine law in all equations that are no identities, and at a
/// structure that was found where that has hardly more terms; the better end counts. In each
/// round terms are ranked by what they explain of the derivatives of means (averaged()) beside
/// those that are there, and the best few are tried in free runs; the one that leaves least
/// comes in, and the least significant terms that are not worth it leave. It ends where nothing
/// gains, or past the deadline.
///
/// Candidates are those of the library, and the plain laws of machines: of each state dry
/// friction as tanh(v/width), its width fitted with the coefficients, v*abs(v), sin(x),
/// sqrt(x), of each input abs(u), which acts more one way than the other.
/// @param found a model of these records. @param least of is_worth(). @param data records with
/// inputs that act (with_inputs_delayed()).
/// @return nothing where neither start has a finite run.
std::optional<FreeRun> plain_structure(const Dataset& data, const TermLibrary& library,
                                       const OdeModel& found, double least,
                                       const KnownNoise& noise, const RunContext& context);

}  // namespace lacuna
