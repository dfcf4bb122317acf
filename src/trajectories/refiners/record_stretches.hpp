// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Stretches of long records, evenly spread, that stand for all of them: about `most` samples
/// in 16 stretches, or in fewer that hold eight windows each, shared out among the records by
/// their lengths. A dataset of at most twice as many samples stays as it is.
/// @param window samples of the shortest windows.
Dataset record_stretches(const Dataset& data, Index most, Index window);

}  // namespace lacuna
