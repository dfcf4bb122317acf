// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// The derivative of one order of some columns of a record.
/// @throws DataError as Differentiator::differentiate, naming the record.
Matrix differentiate_record(const Trajectory& record, const Eigen::Ref<const Matrix>& columns,
                            const Differentiator& differentiator, int order);

/// The record with derivatives: as it is when it brings them; else dx/dt is computed and states
/// and inputs are replaced by the differentiator's order 0.
///
/// Inputs are smoothed like the states because a linear equation that holds for signals holds
/// for signals that all went through the same filter, but not when some of them did.
/// @param smooth false keeps states and inputs as measured.
/// @throws DataError as above.
Trajectory with_derivatives(const Trajectory& record, const Differentiator& differentiator,
                            bool smooth = true);

}  // namespace lacuna
