// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/records/channels/hint.hpp"

namespace lacuna {

/// Columns that are no states of their own, of records without a model:
/// - one that is computed from others, to the last digits that are written: a sum with factors
///   (a copy, an affine image), a product of two, a length sqrt(x^2 + y^2 + z^2); of a sum the
///   last column counts as the computed one;
/// - one whose values change every n-th sample only (n > 1) while others change in between: what
///   a controller puts out.
std::vector<Hint> column_hints(const Dataset& data);

}  // namespace lacuna
