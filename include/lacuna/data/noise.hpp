// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/dataset.hpp"

namespace lacuna {

/// Standard deviation of white measurement noise per state, estimated from the record itself:
/// differences of rising order k kill the smooth signal and leave noise of variance
/// C(2k, k) sigma^2; the order at which the estimate stops falling is taken, and a robust scale
/// (median absolute value) guards against outliers and fast stretches. On a grid that is not
/// uniform divided differences with weights of the same norm take their place.
/// With d_k the k-th difference, order k gives
/// sigma_k = median(|d_k|) / (0.6745 sqrt(C(2k, k))).
/// @return m entries in the units of the states; 0 where no noise can be seen.
Vector estimate_noise(const Dataset& data);

}  // namespace lacuna
