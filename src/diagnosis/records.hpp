// SPDX-License-Identifier: MIT
// Records made ready for a diagnosis.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lacuna/estimation/assimilation.hpp"

namespace lacuna {

/// The records with their short gaps bridged: pieces of one file between which up to nine
/// samples are missing are one record with a longer step. What is still shorter than a window
/// of the gauge is left out. Both are noted.
/// @throws DataError when nothing is left.
Dataset bridged(const Dataset& data, std::vector<std::string>& notes);

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

/// Whether most samples of a state are as the one before them: values on a coarse lattice,
/// whose rounding is not noise that is independent from sample to sample.
bool mostly_repeats(const Dataset& data);

}  // namespace lacuna
