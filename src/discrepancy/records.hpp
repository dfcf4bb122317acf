// SPDX-License-Identifier: MIT
// Records made ready for a diagnosis.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lacuna/data/dataset.hpp"

namespace lacuna {

/// The first three quarters of each record, and the last one.
std::pair<Dataset, Dataset> split_in_time(const Dataset& data);

/// Samples that are outliers of the measurement: per record n x m, 1 where one is.
std::vector<Matrix> mark_outliers(const Dataset& data, std::vector<std::string>& notes);

}  // namespace lacuna
