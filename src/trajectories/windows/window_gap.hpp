// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
// What a model leaves when it runs freely in windows of records.
#pragma once

#include <vector>

#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// Sum of squares of (measured - model) / scale over the samples of windows, and how many there
/// are; windows in which the model has no finite solution count for nothing else.
struct WindowSquares {
  double sum = 0.0;
  double count = 0.0;
  Index diverged = 0;  ///< windows without a finite solution
  /// Mean squares of blocks of about twenty samples: their scatter says how well the whole mean
  /// is known, whatever the noise is like.
  std::vector<double> blocks = {};

  void add(const WindowSquares& other);
  double rms() const;  ///< not finite where no window is left

  /// By how many standard deviations the mean square is above floor^2: the larger of
  /// above_by_scatter() and rms() / floor, as which it counts if all samples are off by one and
  /// the same normal deviation of size `floor`. What blocks scatter by, or how few they are,
  /// does not hide that all of them are far off.
  double above(double floor) const;

  /// The same in standard errors that are found from the scatter over blocks. With few blocks
  /// the errors count as much more as Student's t has them; 0 where there are fewer than two.
  double above_by_scatter(double floor) const;
};

/// Windows of a record one after another: their length, and the first sample of the first.
struct WindowGrid {
  Index begin = 0;
  Index length = 0;
};

/// What was measured of a record.
struct MarkedSamples {
  const Matrix& values;  ///< n x m
  const Matrix& marks;   ///< n x m or 0 x 0 (Mark)
};

/// Windows of one record, in each of which the model runs freely from the initial state that
/// fits best. The record is linearised as a whole, so that delayed terms know what was before a
/// window. Samples that say nothing are left out; one at an end of its channel counts as far as
/// the model does not reach that end.
/// @param noise its disturbances are not looked at.
/// @param scale m entries, by which deviations are divided.
WindowSquares window_squares(const LinearisedRecord& record, const MarkedSamples& measured,
                             const NoiseModel& noise, const Vector& scale,
                             const WindowGrid& grid);

/// Samples of a window: the shortest mean period of a measured state along the paths (n x m
/// each), the samples of the first path where no state has one; no fewer than 20.
Index window_samples(const std::vector<Matrix>& paths, const std::vector<bool>& measured);
Index window_samples(const Assimilation& fit);

/// Root mean square of (measured - model) / (standard deviation of the path) in windows of
/// window_samples() on the records that a model was brought onto. A disturbance that pushes to
/// and fro within a window hardly counts here, one that lasts counts most.
double window_gap(const Assimilation& fit);

/// Standard deviation of each column over several blocks of rows.
/// @throws ArgumentError when they have no row or differ in their columns.
Vector column_deviations(const std::vector<Matrix>& blocks);

/// The same, and 0 for a column that does not move: by it nothing can be measured.
Vector moving_deviations(const std::vector<Matrix>& blocks);

}  // namespace lacuna
