// SPDX-License-Identifier: MIT
#include "averaged_records.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// Weights of the samples about the middle one.
struct Window {
  Vector mean;   ///< sum 1
  Vector slope;  ///< of a straight line it is the slope per sample
};

Window window_of(Index half) {
  const double reach = static_cast<double>(half) + 1.0;
  Window window{Vector(2 * half + 1), Vector(2 * half + 1)};
  for (Index j = -half; j <= half; ++j) {
    const double s = static_cast<double>(j) / reach, rest = 1.0 - s * s;
    window.mean[j + half] = rest * rest * rest;
    window.slope[j + half] = s * rest * rest;
  }
  window.mean /= window.mean.sum();
  double length = 0.0;
  for (Index j = -half; j <= half; ++j)
    length += static_cast<double>(j) * window.slope[j + half];
  window.slope /= length;
  return window;
}

Matrix weighted(const Matrix& samples, const Vector& weights, Index stride) {
  const Index width = weights.size(), count = (samples.rows() - width) / stride + 1;
  Matrix result(count, samples.cols());
  for (Index i = 0; i < count; ++i)
    result.row(i) = weights.transpose() * samples.middleRows(i * stride, width);
  return result;
}

/// Of inputs that are held: about a sample the mean of it and the one before.
Matrix about_samples(const Dataset& data, Matrix inputs) {
  const Index n = inputs.rows();
  for (Index j = 0; j < inputs.cols(); ++j)
    if (data.inputs[static_cast<std::size_t>(j)].hold == Hold::Zero)
      inputs.col(j).tail(n - 1) =
          (0.5 * (inputs.col(j).tail(n - 1) + inputs.col(j).head(n - 1))).eval();
  return inputs;
}

}  // namespace

Dataset averaged(const Dataset& data, Index half) {
  const Window window = window_of(half);
  const Index stride = std::max<Index>(half / 2, 1);
  Dataset result = data;
  for (Quantity& input : result.inputs) input.hold = Hold::Smooth;
  result.trajectories.clear();
  for (const Trajectory& record : data.trajectories) {
    const auto step = uniform_step(record);
    if (!step || record.samples() < 2 * window.mean.size()) continue;
    Trajectory mean;
    mean.source = record.source;
    mean.states = weighted(record.states, window.mean, stride);
    mean.inputs = weighted(about_samples(data, record.inputs), window.mean, stride);
    mean.derivatives = weighted(record.states, window.slope, stride) / *step;
    mean.time = Vector(mean.states.rows());
    for (Index i = 0; i < mean.time.size(); ++i) mean.time[i] = record.time[half + i * stride];
    result.trajectories.push_back(std::move(mean));
  }
  return result;
}

}  // namespace lacuna
