// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "linearisation.hpp"

namespace lacuna {

/// Solves all windows for these values of the columns and makes their solution the path.
/// @return the largest move of a path at a sample in units of sigma; nothing when a window had
///   no finite solution (its path stays).
std::optional<double> move_path(WindowRates& rates, const Linearisation& linearisation,
                                const Vector& values, WindowedPath& path,
                                const RunContext& context);

}  // namespace lacuna
