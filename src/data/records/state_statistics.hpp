// SPDX-License-Identifier: MIT
// What all samples of a dataset have in common. The dataset is a checked one.
#pragma once

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Mean square distance of the samples of a state from their mean, over all records.
double state_variance(const Dataset& data, Index state);

/// m: how far the samples of each state reach over all records; never 0.
Vector state_spans(const Dataset& data);

/// Whether some samples are marked: no values, or at an end of their channel.
bool has_marks(const Dataset& data);

}  // namespace lacuna
