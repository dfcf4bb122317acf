// SPDX-License-Identifier: MIT
#include "reference_path.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/data/noise.hpp"
#include "lacuna/flow/node_grid.hpp"
#include "lacuna/selection/moving_polynomial.hpp"

namespace lacuna {
namespace {

/// Samples that are outliers take the value of the straight line between their neighbours.
Vector without_outliers(const Trajectory& record, Index state, double noise) {
  Vector values = record.states.col(state);
  const Vector& t = record.time;
  for (const Index i : outlying_samples(record, state, noise)) {
    const double share = (t[i] - t[i - 1]) / (t[i + 1] - t[i - 1]);
    values[i] = (1.0 - share) * values[i - 1] + share * values[i + 1];
  }
  return values;
}

void place_path(PathRecord& record, const Matrix& states, const Program& program) {
  Matrix values(states.rows(), states.cols() + record.samples.inputs.cols());
  values << states, record.samples.inputs;
  const Matrix variables = node_slots(record.samples.time, values, record.stride());
  const Index width = variables.cols();
  record.time = variables.col(width - 1);
  record.slots.resize(variables.rows(), program.slots());
  record.slots.leftCols(width) = variables;
  record.slots.rightCols(program.slots() - width) =
      delayed_slots(variables, record.stride(), program.delays());
}

Matrix weights_of(const Trajectory& record, const Dataset& data, const Vector& noise) {
  Matrix weights = Matrix::Zero(record.samples(), record.states.cols());
  for (Index k = 0; k < weights.cols(); ++k) {
    if (is_derived(data, k)) continue;
    weights.col(k).setConstant(1.0 / noise[k]);
    for (const Index i : outlying_samples(record, k, noise[k])) weights(i, k) = 0.0;
  }
  return weights;
}

Matrix stacked(const Matrix& a, const Matrix& b) {
  Matrix both(a.rows() + b.rows(), a.cols());
  both << a, b;
  return both;
}

void append(Trajectory& target, const Trajectory& more) {
  target.time = stacked(target.time, more.time);
  target.states = stacked(target.states, more.states);
  target.inputs = stacked(target.inputs, more.inputs);
  if (target.has_derivatives())
    target.derivatives = stacked(target.derivatives, more.derivatives);
}

}  // namespace

bool is_derived(const Dataset& data, Index state) {
  if (data.rate_of.empty()) return false;
  const std::string& name = data.states[static_cast<std::size_t>(state)].name;
  return std::any_of(data.states.begin(), data.states.end(), [&](const Quantity& other) {
    const bool longer = name.size() > other.name.size() + 2;
    if (!longer || name.rfind(other.name + "_", 0) != 0) return false;
    const char kind = name[other.name.size() + 1];
    return (kind == 'd' || kind == 'i') &&
           name.find_first_not_of("0123456789", other.name.size() + 2) == std::string::npos;
  });
}

Dataset joined_across_gaps(const Dataset& data) {
  constexpr double kLongestGap = 5.5;  // steps
  const double longest_gap = kLongestGap * median_step(longest_record(data));
  Dataset joined = data;
  joined.trajectories.clear();
  for (const Trajectory& record : data.trajectories) {
    Trajectory* before = joined.trajectories.empty() ? nullptr : &joined.trajectories.back();
    if (before && before->has_derivatives() == record.has_derivatives() &&
        goes_on(*before, record, longest_gap))
      append(*before, record);
    else
      joined.trajectories.push_back(record);
  }
  return joined;
}

Matrix smoothed_states(const Trajectory& record, const Dataset& data, const Vector& noise) {
  Matrix smooth = record.states;
  std::vector<Matrix> fits(static_cast<std::size_t>(smooth.cols()));
  for (Index k = 0; k < smooth.cols(); ++k) {
    if (is_derived(data, k)) continue;
    auto& fit = fits[static_cast<std::size_t>(k)];
    fit = smooth_by_polynomials(record.time, without_outliers(record, k, noise[k]), noise[k]);
    smooth.col(k) = fit.col(0);
  }
  for (Index k = 0; k < smooth.cols(); ++k) {
    const std::optional<Index> rate = data.rate_state(k);
    const Matrix& fit = fits[static_cast<std::size_t>(k)];
    if (rate && is_derived(data, *rate) && fit.size() > 0) smooth.col(*rate) = fit.col(1);
  }
  return smooth;
}

std::vector<PathRecord> make_paths(const Dataset& data, const Vector& noise,
                                   const Program& program) {
  std::vector<PathRecord> paths;
  for (const Trajectory& record : data.trajectories) {
    PathRecord path{record, weights_of(record, data, noise), 1, {}, {}};
    place_path(path, smoothed_states(record, data, noise), program);
    paths.push_back(std::move(path));
  }
  return paths;
}

void set_substeps(PathRecord& record, Index substeps, const Program& program) {
  const Matrix states = record.slots(Eigen::seqN(0, record.samples.samples(), record.stride()),
                                     Eigen::seqN(0, record.samples.states.cols()));
  record.substeps = substeps;
  place_path(record, states, program);
}

}  // namespace lacuna
