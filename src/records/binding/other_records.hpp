// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Records that are to judge a model must not be those that it was made of: what is said of
/// them is said of samples that were not used.
/// @throws DataError naming a held-out record all samples of which stand in a row in one that
/// is
///   used, at the same times or from its first sample on.
void check_are_others(const Dataset& used, const Dataset& held_out);

}  // namespace lacuna
