// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Whether some states are seen to be no function of others and of the inputs, as the velocity
/// of an oscillator is none of its position. All columns are divided by their deviations. Where
/// the path of one of 300 samples, in the r columns `of` and the inputs, comes back within
/// 0.1 sqrt(r) of it after it was three times as far away, or another record comes there, the
/// states have to differ by no more than four times their root mean square difference within
/// that distance on the sample's own path. They are many-valued where 15 % of at least 20 such
/// samples differ by more.
/// @return false where the records do not come back.
/// @throws ArgumentError when there is no such state, or records have not the columns of the
///   dataset.
bool is_many_valued(const Dataset& data, const std::vector<Index>& states,
                    const std::vector<Index>& of);

}  // namespace lacuna
