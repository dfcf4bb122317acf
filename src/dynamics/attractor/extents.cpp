// SPDX-License-Identifier: MIT
#include "dynamics/attractor/extents.hpp"

#include <cmath>

#include "core/base/check.hpp"
#include "lacuna/core/numerics/interval.hpp"

namespace lacuna {
namespace {

Vector size_of(const Matrix& low_and_high) {
  return (low_and_high.row(1) - low_and_high.row(0)).transpose();
}

/// Smallest values in row 0, largest in row 1.
Matrix bounds_of(const Eigen::Ref<const Matrix>& states) {
  Matrix bounds(2, states.cols());
  bounds << states.colwise().minCoeff(), states.colwise().maxCoeff();
  return bounds;
}

Matrix bounds_of(const Dataset& record) {
  Matrix bounds = bounds_of(record.trajectories[0].states);
  for (const Trajectory& trajectory : record.trajectories) {
    const Matrix other = bounds_of(trajectory.states);
    bounds.row(0) = bounds.row(0).cwiseMin(other.row(0));
    bounds.row(1) = bounds.row(1).cwiseMax(other.row(1));
  }
  return bounds;
}

/// One row per block: the sizes and, last, the volume.
Matrix block_sizes(const Dataset& record, Index blocks) {
  Matrix sizes(blocks * static_cast<Index>(record.trajectories.size()),
               record.state_count() + 1);
  Index row = 0;
  for (const Trajectory& trajectory : record.trajectories) {
    const Index length = trajectory.samples() / blocks;
    if (length < 2)
      throw ArgumentError(
          "attractor_extents",
          trajectory.source + " is too short for " + std::to_string(blocks) + " blocks",
          "use fewer blocks");
    for (Index b = 0; b < blocks; ++b, ++row) {
      const Vector size = size_of(bounds_of(trajectory.states.middleRows(b * length, length)));
      sizes.row(row) << size.transpose(), size.prod();
    }
  }
  return sizes;
}

Vector half_widths(const Matrix& samples) {
  const double count = static_cast<double>(samples.rows());
  const Matrix off = samples.rowwise() - samples.colwise().mean();
  const Vector deviation = (off.colwise().squaredNorm() / (count - 1.0)).cwiseSqrt();
  return student_quantile_975(count - 1.0) / std::sqrt(count) * deviation;
}

}  // namespace

AttractorExtents attractor_extents(const Dataset& record, Index blocks) {
  check_dataset(record);
  if (blocks < 2)
    throw ArgumentError("attractor_extents", "an interval needs at least 2 blocks", "");
  check_argument(blocks <= record.samples(), "attractor_extents",
                 "there are more blocks than samples", "use fewer blocks");
  const Vector reach = half_widths(block_sizes(record, blocks));
  AttractorExtents extents;
  extents.size = size_of(bounds_of(record));
  extents.half_width = reach.head(extents.size.size());
  extents.volume = extents.size.prod();
  extents.volume_half_width = reach[extents.size.size()];
  check_argument(reach.allFinite() && extents.size.allFinite() && std::isfinite(extents.volume),
                 "attractor_extents", "the sizes or their product are beyond the numbers",
                 "use larger units");
  return extents;
}

}  // namespace lacuna
