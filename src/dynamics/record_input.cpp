// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/record_input.hpp"

#include <algorithm>
#include <utility>

namespace lacuna {

RecordInput::RecordInput(Vector time, Matrix inputs, Index points)
    : time_(std::move(time)),
      inputs_(std::move(inputs)),
      points_(points),
      interpolant_(time_, inputs_, LagrangeWindow::centred(points)) {}

RecordInput::RecordInput(const Trajectory& trajectory, Index points)
    : RecordInput(trajectory.time, trajectory.inputs, points) {}

RecordInput::RecordInput(const RecordInput& other)
    : RecordInput(other.time_, other.inputs_, other.points_) {}

void RecordInput::operator()(double t, double* u) {
  const double inside = std::clamp(t, time_[0], time_[time_.size() - 1]);
  interpolant_.select(interpolant_.interval_of(inside));
  interpolant_.evaluate(inside, u);
}

}  // namespace lacuna
