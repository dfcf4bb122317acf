// SPDX-License-Identifier: MIT
// How finely values are written.
#pragma once

#include "lacuna/data/dataset.hpp"

namespace lacuna {

/// Spacing of the values of each state: of their lattice, no finer than numbers of seven digits
/// have at its largest value. m entries.
Vector value_spacings(const Dataset& data);

}  // namespace lacuna
