// SPDX-License-Identifier: MIT
#include <string>

#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"

namespace lacuna {
namespace {

std::vector<Interpolation> interpolations_of(const std::vector<Quantity>& inputs) {
  std::vector<Interpolation> result;
  for (const Quantity& input : inputs) result.push_back(interpolation_of(input.hold));
  return result;
}

std::vector<Interpolation> alike(Index inputs, Interpolation interpolation) {
  return {static_cast<std::size_t>(inputs), interpolation};
}

}  // namespace

RecordInput::RecordInput(const Vector& time, const Matrix& inputs, Interpolation interpolation)
    : RecordInput(time, inputs, alike(inputs.cols(), interpolation)) {}

RecordInput::RecordInput(const Trajectory& trajectory, Interpolation interpolation)
    : RecordInput(trajectory.time, trajectory.inputs, interpolation) {}

RecordInput::RecordInput(const Trajectory& trajectory, const std::vector<Quantity>& inputs)
    : RecordInput(trajectory.time, trajectory.inputs, interpolations_of(inputs)) {}

RecordInput::RecordInput(const Vector& time, const Matrix& inputs,
                         const std::vector<Interpolation>& interpolations) {
  if (time.size() == 0 || inputs.rows() != time.size() ||
      inputs.cols() != static_cast<Index>(interpolations.size()))
    throw ArgumentError("RecordInput",
                        std::to_string(inputs.rows()) + " x " + std::to_string(inputs.cols()) +
                            " samples for " + std::to_string(time.size()) + " times and " +
                            std::to_string(interpolations.size()) + " inputs",
                        "give a row for each time and a column for each input");
  for (Index j = 0; j < inputs.cols(); ++j) {
    const Interpolation interpolation = interpolations[static_cast<std::size_t>(j)];
    signals_.emplace_back(time, inputs.col(j), interpolation);
    smooth_ = smooth_ && is_smooth(interpolation);
  }
}

void RecordInput::operator()(double t, double* u) {
  for (SampledSignal& signal : signals_) *u++ = signal(t);
}

Vector RecordInput::breaks() const { return smooth_ ? Vector() : signals_.front().time(); }

}  // namespace lacuna
