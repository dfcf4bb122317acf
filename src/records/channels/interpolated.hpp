// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Samples of a signal that were put on straight lines between others: those on the line
/// between their neighbours, where all of these runs begin whole multiples of a number of
/// samples apart and are shorter (a channel that is slower than the rest, brought to its
/// times). None where that is not so: dense samples of a smooth signal lie nearly on lines as
/// well, but not so regularly.
/// @param time, values n. @param spacing of the digits of the values.
/// @throws ArgumentError when times and values differ in number.
std::vector<Index> interpolated_samples(const Vector& time,
                                        const Eigen::Ref<const Vector>& values, double spacing);

/// Such samples of an input of a record, whose numbers have seven digits.
/// @throws ArgumentError when there is no such input.
std::vector<Index> interpolated_samples(const Trajectory& record, Index input);

/// Whether some record has such samples of an input.
bool is_interpolated(const Dataset& data, Index input);

/// The records with such samples of measured states marked as missing.
Dataset with_interpolated_marked(Dataset data);

}  // namespace lacuna
