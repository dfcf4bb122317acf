// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// The spacing q of which all differences of the values of a state are whole multiples, if
/// there is one. It is found from the small gaps and made more exact by the large ones, over
/// which rounded digits matter least. Where the differences are multiples of a coarser step but
/// for the rounding of the text (an ADC of 0.3223 K printed to 0.01 K) it is that step.
/// @param data with finite values; samples that are marked as none are left out.
std::optional<double> lattice_of(const Dataset& data, Index state);

}  // namespace lacuna
