// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/records/channels/limits.hpp"

namespace lacuna::cli {

/// The records with the ends of channels that are given as "q=-5:5", "q=:5" or "q=-5:".
/// @throws ConfigError for another form, a name that is no state, or an empty range.
Dataset with_given_limits(Dataset data, const std::vector<std::string>& texts);

}  // namespace lacuna::cli
