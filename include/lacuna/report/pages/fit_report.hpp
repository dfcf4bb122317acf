// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {

/// The fit for people: numbers with intervals, quality, what is not determined.
std::string format_text(const Fit& fit);

/// The fit as JSON of the format "lacuna.fit/1".
std::string format_json(const Fit& fit);

}  // namespace lacuna
