// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/dataset.hpp"

namespace lacuna {

/// Standard deviation of white measurement noise per state, estimated from the record itself:
/// differences of rising order k kill the smooth signal and leave noise of variance
/// C(2k, k) sigma^2; the order at which the estimate stops falling is taken, and a robust scale
/// (median absolute value) guards against outliers and fast stretches.
/// @return m entries in the units of the states; 0 where no noise can be seen.
Vector estimate_noise(const Dataset& data);

}  // namespace lacuna
