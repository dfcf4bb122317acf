// SPDX-License-Identifier: MIT
// How finely values are written.
#pragma once

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Spacing of numbers of seven digits at the largest of some values.
double spacing_of_digits(const Eigen::Ref<const Vector>& values);

/// Spacing of the values of each state: of their lattice, no finer than spacing_of_digits(), nor
/// than the median gap between the values to which it comes back, which a lattice of uneven
/// steps has.
/// m entries.
Vector value_spacings(const Dataset& data);

}  // namespace lacuna
