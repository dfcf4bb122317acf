// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// The size of an attractor: what Table 2 of Karimov et al. 2023 lists.
struct AttractorExtents {
  Vector size;          ///< max - min of each state over the whole record, state units
  Vector half_width;    ///< of the 95 % interval of each
  double volume = 0.0;  ///< product of the sizes: of the box around the attractor
  double volume_half_width = 0.0;  ///< of its 95 % interval
};

/// Extents of all states. Every trajectory is cut into `blocks` parts of equal length; the
/// sizes of the parts scatter with standard deviation s, and the 95 % interval of the mean of B
/// parts, t_{0.975, B-1} s / sqrt(B), is given as half width. The interval says how far records
/// of that length would differ; parts are a little smaller than the whole, which is not
/// counted.
/// @throws ArgumentError for fewer than 2 blocks or less than 2 samples in a block.
/// The same for more blocks than samples and for sizes whose product is beyond doubles;
///   DataError as check_dataset().
AttractorExtents attractor_extents(const Dataset& record, Index blocks = 5);

}  // namespace lacuna
