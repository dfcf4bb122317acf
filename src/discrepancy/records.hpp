// SPDX-License-Identifier: MIT
// Records made ready for a diagnosis.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lacuna/innovation/assimilation.hpp"

namespace lacuna {

/// The first three quarters of each record, and the last one.
std::pair<Dataset, Dataset> split_in_time(const Dataset& data);

/// Samples that may be outliers of the measurement: per record n x m, 1 where one is.
std::vector<Matrix> mark_outliers(const Dataset& data);

/// Takes the mark from samples that the path, found without them, explains after all: sharp
/// turns of the signal look like outliers before there is a model. Notes the number of those
/// that stay.
/// @return whether a mark was taken away.
bool clear_false_outliers(const Dataset& data, Assimilation& fit,
                          std::vector<std::string>& notes);

}  // namespace lacuna
