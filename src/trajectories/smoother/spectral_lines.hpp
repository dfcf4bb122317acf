// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// The strongest lines of the disturbances along the longest record, `count` for each equation,
/// strongest first.
std::vector<SpectralLine> spectral_lines(const Assimilation& fit, Index count);

/// The strongest lines of d(t) m(t) along the longest record, d the disturbance of an equation and
/// m a term of it that varies, with the terms: of d = A m sin(2 pi f t + phase) that sum of least
/// squares finds f and the phase. One for each term, strongest first, `count` in each equation.
std::vector<ModulationLine> modulation_lines(const Assimilation& fit, Index count);

}  // namespace lacuna
