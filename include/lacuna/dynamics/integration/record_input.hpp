// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/numerics/sampled_signal.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Recorded inputs as a signal for simulate(): each goes on between its samples as it is held,
/// or as the line or the polynomial through the nearest samples of it, on any increasing grid;
/// before and after the record the first and the last sample hold. A value; not for use from
/// several threads at once.
class RecordInput {
 public:
  /// @param inputs n x p samples. @throws ArgumentError when shapes do not fit or there is no
  /// sample.
  RecordInput(const Vector& time, const Matrix& inputs,
              Interpolation interpolation = Interpolation::Quintic);

  /// The inputs of a trajectory, all alike.
  explicit RecordInput(const Trajectory& trajectory,
                       Interpolation interpolation = Interpolation::Quintic);

  /// The inputs of a trajectory, each as Quantity::hold says.
  RecordInput(const Trajectory& trajectory, const std::vector<Quantity>& inputs);

  /// Writes the p inputs at time t; at a jump the value behind it.
  void operator()(double t, double* u);

  /// Times at which an input jumps or bends: its n samples, none when all inputs are smooth.
  Vector breaks() const;

 private:
  RecordInput(const Vector& time, const Matrix& inputs,
              const std::vector<Interpolation>& interpolations);

  std::vector<SampledSignal> signals_;
  bool smooth_ = true;
};

}  // namespace lacuna
