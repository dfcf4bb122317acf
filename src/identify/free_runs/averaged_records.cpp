// SPDX-License-Identifier: MIT
#include "averaged_records.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lacuna/core/numerics/sampled_signal.hpp"

namespace lacuna {
namespace {

/// Coefficients of a polynomial in s, the constant first.
using Powers = std::vector<double>;

Powers derived(const Powers& p) {
  Powers result;
  for (std::size_t i = 1; i < p.size(); ++i) result.push_back(static_cast<double>(i) * p[i]);
  return result;
}

/// (1 - s^2)^5, which has four continuous derivatives at the ends.
Powers bell() { return {1.0, 0.0, -5.0, 0.0, 10.0, 0.0, -10.0, 0.0, 5.0, 0.0, -1.0}; }

double at(const Powers& p, double s) {
  double value = 0.0;
  for (auto i = p.rbegin(); i != p.rend(); ++i) value = value * s + *i;
  return value;
}

/// sum_j weights_j j^power / power!
double moment(const Vector& weights, Index half, int power) {
  double sum = 0.0, factorial = 1.0;
  for (int i = 2; i <= power; ++i) factorial *= i;
  for (Index j = -half; j <= half; ++j)
    sum += weights[j + half] * std::pow(static_cast<double>(j), power);
  return sum / factorial;
}

/// Weights that make of the samples about the middle one the derivative of their mean, per
/// sample to this order: exact for polynomials of that degree.
Vector weights_of(Index half, int order) {
  const double reach = static_cast<double>(half) + 1.0;
  Powers window = bell();
  for (int i = 0; i < order; ++i) window = derived(window);
  Vector weights(2 * half + 1), mean(2 * half + 1);
  for (Index j = -half; j <= half; ++j) {
    weights[j + half] = at(window, static_cast<double>(j) / reach);
    mean[j + half] = at(bell(), static_cast<double>(j) / reach);
  }
  // What sampling the window leaves of lower degrees of the same parity.
  for (int lower = order - 2; lower >= 0; lower -= 2) {
    Vector part = mean;
    for (Index j = -half; j <= half; ++j)
      part[j + half] *= std::pow(static_cast<double>(j), lower);
    weights -= moment(weights, half, lower) / moment(part, half, lower) * part;
  }
  return weights / moment(weights, half, order);
}

/// Of which channel a state is a derivative, and to what order: what was made of samples by
/// differences is made of their means instead.
std::pair<Index, int> origin_of(const Dataset& data, Index state) {
  int order = 0;
  for (bool found = true; found && !data.is_measured(state);) {
    found = false;
    for (Index j = 0; j < data.state_count(); ++j)
      if (data.rate_state(j) == state) {
        state = j;
        ++order;
        found = true;
        break;
      }
  }
  return {state, order};
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

Vector at_times(const Vector& time, const Vector& values, const Vector& own,
                Interpolation between) {
  SampledSignal signal(own, values, between);
  return time.unaryExpr([&](double t) { return signal(t); });
}

/// A record of uneven steps at as many even ones.
Trajectory at_even_steps(const Dataset& data, Trajectory record) {
  if (record.samples() < 2 || uniform_step(record)) return record;
  const Vector own = record.time;
  record.time = Vector::LinSpaced(own.size(), own[0], own[own.size() - 1]);
  for (Index k = 0; k < record.states.cols(); ++k)
    record.states.col(k) =
        at_times(record.time, record.states.col(k), own, Interpolation::Cubic);
  for (Index j = 0; j < record.inputs.cols(); ++j)
    record.inputs.col(j) =
        at_times(record.time, record.inputs.col(j), own,
                 interpolation_of(data.inputs[static_cast<std::size_t>(j)].hold));
  return record;
}

}  // namespace

Dataset averaged(const Dataset& data, Index half) {
  const Index width = 2 * half + 1;
  const Index stride = std::max<Index>(half / 2, 1);
  Dataset result = data;
  for (Quantity& input : result.inputs) input.hold = Hold::Smooth;
  result.trajectories.clear();
  for (const Trajectory& given : data.trajectories) {
    if (given.samples() < 2 * width) continue;
    const Trajectory record = at_even_steps(data, given);
    const double step = mean_step(record);
    Trajectory mean;
    mean.source = record.source;
    mean.inputs = weighted(about_samples(data, record.inputs), weights_of(half, 0), stride);
    mean.states.resize(mean.inputs.rows(), data.state_count());
    mean.derivatives.resize(mean.inputs.rows(), data.state_count());
    for (Index k = 0; k < data.state_count(); ++k) {
      const auto [channel, order] = origin_of(data, k);
      const Matrix samples = record.states.col(channel);
      mean.states.col(k) =
          weighted(samples, weights_of(half, order), stride) / std::pow(step, order);
      mean.derivatives.col(k) =
          weighted(samples, weights_of(half, order + 1), stride) / std::pow(step, order + 1);
    }
    mean.time = Vector(mean.states.rows());
    for (Index i = 0; i < mean.time.size(); ++i) mean.time[i] = record.time[half + i * stride];
    result.trajectories.push_back(std::move(mean));
  }
  return result;
}

}  // namespace lacuna
