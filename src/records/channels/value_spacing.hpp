// SPDX-License-Identifier: MIT
// How finely values are written.
#pragma once

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Spacing of numbers of seven digits at the largest of some values.
double spacing_of_digits(const Eigen::Ref<const Vector>& values);

/// Median gap between the values that a state takes, where it comes back to them; 0 where most
/// occur once. A lattice with uneven steps (a thermistor, a root) has no spacing but this.
double gap_of_visited(const Dataset& data, Index state);

/// Spacing of the values of each state: of their lattice, no finer than spacing_of_digits().
/// m entries.
Vector value_spacings(const Dataset& data);

}  // namespace lacuna
