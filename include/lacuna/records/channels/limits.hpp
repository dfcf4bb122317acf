// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Ends of the range of a channel, beyond which it shows the end instead; nothing where it has
/// none that matters.
struct Limits {
  std::optional<double> low = {}, high = {};
};

/// Ends that the samples of each state show. At an end many samples have one value exactly:
/// more than `pile_up` times as many as have any value next to it, at least as many as that,
/// and the signal comes there at its speed. What comes to rest does so by ever smaller steps,
/// the last of which is one of the lattice; what is stopped by a force repeats no value, as its
/// noise goes on. Samples with which a record begins do not show how the signal came there and
/// count for nothing; where a record begins so while inputs and other states rest, the value is
/// one of rest, and only samples count in which something else has another value than there.
/// @param data samples that are no values are not looked at. @return m entries.
/// @throws ArgumentError when a record has not the columns of the dataset, or a sample is not
///   finite.
std::vector<Limits> visible_limits(const Dataset& data, double pile_up);

/// The records with the samples marked that are at an end of their channel or beyond, where
/// they get the value of the end. Samples that say nothing keep their marks.
/// @param limits m entries.
/// @throws ArgumentError when a record has not the columns of the dataset.
Dataset with_limits(Dataset data, const std::vector<Limits>& limits);

}  // namespace lacuna
