// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/trajectories/fit/rivals.hpp"

namespace lacuna {

/// The comparison for people: a table, the best first, and what the records do not distinguish.
std::string format_text(const RivalComparison& comparison);

/// The comparison as JSON of the format "lacuna.rivals/1".
std::string format_json(const RivalComparison& comparison);

}  // namespace lacuna
