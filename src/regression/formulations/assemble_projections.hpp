// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/term.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "regression/formulations/projection.hpp"

namespace lacuna {

/// The whitened system of the projections of a dataset, one per record.
/// @throws DataError when no functional fits into a record or a term is not finite.
LeastSquaresSystem assemble_projections(const Dataset& data, const TermLibrary& library,
                                        const std::vector<Projection>& projections,
                                        const RunContext& context);

}  // namespace lacuna
