// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Values of the variables of a library at samples first, first + 1, ..., one for each row, in
/// the first columns: states, inputs, time.
/// @return whether all values are finite.
bool fill_variables(const Trajectory& record, Index first, Eigen::Ref<Matrix> slots);

}  // namespace lacuna
