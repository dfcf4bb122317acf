// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/trajectory.hpp"
#include "lacuna/numerics/lagrange.hpp"

namespace lacuna {

/// Recorded inputs as a signal for simulate(): the Lagrange polynomial through the nearest
/// samples of u, on any increasing grid; before and after the record the first and the last
/// sample hold. Owns a copy of the samples. Not for use from several threads at once: copy it.
class RecordInput {
 public:
  /// @param inputs n x p samples; @param points 1 holds the last sample, 2 is linear, 4 cubic.
  /// @throws ArgumentError when shapes do not fit or there are fewer than `points` samples.
  RecordInput(Vector time, Matrix inputs, Index points = 4);

  /// The inputs of a trajectory.
  explicit RecordInput(const Trajectory& trajectory, Index points = 4);

  RecordInput(const RecordInput& other);
  RecordInput& operator=(const RecordInput&) = delete;

  /// Writes the p inputs at time t.
  void operator()(double t, double* u);

 private:
  Vector time_;
  Matrix inputs_;
  Index points_;
  LagrangeInterpolant interpolant_;
};

}  // namespace lacuna
