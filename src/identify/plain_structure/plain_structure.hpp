// SPDX-License-Identifier: MIT
// The plain structure of records that nothing fits to the noise.
#pragma once

#include <optional>

#include "identify/free_runs/free_run.hpp"
#include "lacuna/model/equations/term.hpp"

namespace lacuna {

/// A structure whose terms are all worth it in free runs (is_worth()), found by a search by
/// single terms. It begins at the affine law in all equations that are no identities. In each
/// round terms are ranked by what they explain of the derivatives of means (averaged()) beside
/// those that are there, and the best few are tried in free runs; the one that leaves least
/// comes in, and the least significant terms that are not worth it leave. It ends where nothing
/// gains, or past the deadline.
///
/// Candidates are those of the library, and the plain laws of machines of each state: dry
/// friction as tanh(v/width), its width fitted with the coefficients, v*abs(v), sin(x),
/// sqrt(x).
/// @param least of is_worth(). @param data records with inputs that act
/// (with_inputs_delayed()).
/// @return nothing where the affine law has no finite run.
std::optional<FreeRun> plain_structure(const Dataset& data, const TermLibrary& library,
                                       double least, const RunContext& context);

}  // namespace lacuna
