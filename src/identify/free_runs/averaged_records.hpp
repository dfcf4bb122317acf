// SPDX-License-Identifier: MIT
// Records without what is faster than some samples.
#pragma once

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Weighted means of all channels over 2 `half` + 1 samples with the window (1 - s^2)^5, at
/// every half / 2-th sample, and the derivatives of the states' means, which need no difference
/// of noisy samples: the window's own derivatives fall on the samples, for states that were
/// made of a channel by differences too. A system that is linear leaves the means as it leaves
/// the samples; means of an input that is held are those of what it is between samples. Records
/// of uneven steps count at as many even ones, between their samples as these go on; those
/// shorter than two windows are left out.
/// @param half at least 1; 2 for derivatives of the third order.
Dataset averaged(const Dataset& data, Index half);

}  // namespace lacuna
