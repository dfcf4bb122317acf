// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/derivatives/differentiator.hpp"

namespace lacuna {

/// The middle of the longest record, from which open parameters are chosen. A decision: 4096
/// samples determine mean squares to two per cent. @param most of its samples.
Dataset middle_of(const Dataset& data, Index most = 4096);

/// A dataset of one record without inputs.
Dataset dataset_of(const Vector& time, const Eigen::Ref<const Matrix>& values);

/// The noise where it is given, else estimate_noise() of the record.
Vector noise_of(const Dataset& data, const std::optional<Vector>& noise);

/// @throws DataError, saying how many samples `name` needs, when there are fewer.
void check_samples(std::string_view name, Index samples, Index fewest);

}  // namespace lacuna
