// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// What the noise of each state has to be larger than to be seen: a fraction of 1e-4 of what
/// the state moves from one sample to the next (rms), below any error of a model that counts.
/// Less is rounding, digits or the error of a solver.
Vector unseen_noise(const Dataset& data);

}  // namespace lacuna
