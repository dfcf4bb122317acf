// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/records/channels/limits.hpp"

namespace lacuna {

/// The ends of channels that no value of other records is beyond, as one would be that the channel
/// shows.
/// @param limits m entries.
/// @throws ArgumentError when a record has not the columns of the dataset.
std::vector<Limits> limits_kept_by(const Dataset& data, std::vector<Limits> limits);

}  // namespace lacuna
