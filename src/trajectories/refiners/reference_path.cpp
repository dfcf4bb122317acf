// SPDX-License-Identifier: MIT
#include "reference_path.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.hpp"
#include "data/derivatives/moving_polynomial.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/records/channels/node_grid.hpp"
#include "records/channels/shown_holds.hpp"

namespace lacuna {
namespace {

/// Samples that are outliers take the value of the straight line between their neighbours.
Vector without_outliers(const Trajectory& record, Index state, const Vector& noise) {
  Vector values = record.states.col(state);
  const Vector& t = record.time;
  for (const Index i : outlying_samples(record, state, noise)) {
    const double fraction = (t[i] - t[i - 1]) / (t[i + 1] - t[i - 1]);
    values[i] = (1.0 - fraction) * values[i - 1] + fraction * values[i + 1];
  }
  return values;
}

/// A held input at the nodes: its sample until the next one, and at a sample the mean of both
/// limits, so that the parts of an integral on either side of a jump are off by opposite amounts.
Vector held_nodes(const Eigen::Ref<const Vector>& samples, Index stride) {
  const Index last = samples.size() - 1;
  Vector nodes(last * stride + 1);
  for (Index i = 0; i < last; ++i) {
    nodes.segment(i * stride, stride).setConstant(samples[i]);
    if (i > 0) nodes[i * stride] = 0.5 * (samples[i - 1] + samples[i]);
  }
  nodes[last * stride] = samples[std::max<Index>(last - 1, 0)];
  return nodes;
}

void place_path(PathRecord& record, const Matrix& states, const Program& program) {
  Matrix values(states.rows(), states.cols() + record.samples.inputs.cols());
  values << states, record.samples.inputs;
  Matrix variables = node_slots(record.samples.time, values, record.stride());
  for (const Index j : record.held)
    variables.col(states.cols() + j) = held_nodes(record.samples.inputs.col(j), record.stride());
  const Index width = variables.cols();
  record.time = variables.col(width - 1);
  record.slots.resize(variables.rows(), program.slots());
  record.slots.leftCols(width) = variables;
  record.slots.rightCols(program.slots() - width) =
      delayed_slots(variables, record.stride(), program.delays());
}

Matrix weights_of(const Trajectory& record, const Dataset& data, const Matrix& noise,
                  int threads) {
  Matrix weights = Matrix::Zero(record.samples(), record.states.cols());
  parallel_for(data.states.size(), threads, [&](std::size_t state) {
    const auto k = static_cast<Index>(state);
    if (!data.is_measured(k)) return;
    weights.col(k) = noise.col(k).cwiseInverse();
    for (const Index i : outlying_samples(record, k, noise.col(k))) weights(i, k) = 0.0;
  });
  return weights;
}

}  // namespace

Matrix smoothed_states(const Trajectory& record, const Dataset& data, const Matrix& noise,
                       int threads) {
  Matrix smooth = record.states;
  std::vector<Matrix> fits(static_cast<std::size_t>(smooth.cols()));
  parallel_for(fits.size(), threads, [&](std::size_t state) {
    const auto k = static_cast<Index>(state);
    if (!data.is_measured(k)) return;
    const Vector sigma = noise.col(k);
    fits[state] = smooth_by_polynomials(record.time, without_outliers(record, k, sigma), sigma);
    smooth.col(k) = fits[state].col(0);
  });
  for (Index k = 0; k < smooth.cols(); ++k) {
    const std::optional<Index> rate = data.rate_state(k);
    const Matrix& fit = fits[static_cast<std::size_t>(k)];
    if (rate && !data.is_measured(*rate) && fit.size() > 0) smooth.col(*rate) = fit.col(1);
  }
  return smooth;
}

std::vector<PathRecord> make_paths(const Dataset& data, const std::vector<Matrix>& noise,
                                   const Program& program, int threads) {
  std::vector<PathRecord> paths(data.trajectories.size());
  // Several records go side by side, the states of a single one.
  const int within = paths.size() == 1 ? threads : 1;
  parallel_for(paths.size(), threads, [&](std::size_t r) {
    const Trajectory& record = data.trajectories[r];
    paths[r] = {record, weights_of(record, data, noise[r], within), 1, held_inputs(data), {}, {}};
    place_path(paths[r], smoothed_states(record, data, noise[r], within), program);
  });
  return paths;
}

void set_substeps(PathRecord& record, Index substeps, const Program& program) {
  const Matrix states = record.slots(Eigen::seqN(0, record.samples.samples(), record.stride()),
                                     Eigen::seqN(0, record.samples.states.cols()));
  record.substeps = substeps;
  place_path(record, states, program);
}

}  // namespace lacuna
