// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "forms/candidate/spectral_line.hpp"
#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// The strongest lines of the disturbances along the longest record, `count` for each equation,
/// strongest first.
std::vector<SpectralLine> spectral_lines(const Assimilation& fit, Index count);

}  // namespace lacuna
