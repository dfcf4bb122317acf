// SPDX-License-Identifier: MIT
#include "assimilation_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/least_squares.hpp"
#include "data/records/state_statistics.hpp"
#include "determined_step.hpp"
#include "trajectories/smoother/innovation_system.hpp"
#include "unknown_past.hpp"

namespace lacuna {
namespace {

OdeModel with_coefficients(const OdeModel& model, const std::vector<CoefficientPlace>& places,
                           const Vector& change) {
  std::vector<Equation> equations = model.equations();
  for (std::size_t j = 0; j < places.size(); ++j)
    equations[static_cast<std::size_t>(places[j].equation)]
             [static_cast<std::size_t>(places[j].term)]
                 .coefficient += change[static_cast<Index>(j)];
  return model.with_equations(std::move(equations));
}

/// What a step cannot be predicted better than: noise and disturbances. Where a state is not
/// measured, a thousandth of its range.
Vector accuracy_of(const Assimilation& state, const Dataset& data) {
  Vector result = state_spans(data) * 1e-3;
  // A free input has no column: it is as accurate as its path asks for, to begin with as 1.
  for (Index k = 0; k < result.size(); ++k) {
    for (const LinearisedRecord& record : state.records) {
      const auto& path = record.path.col(k);
      result[k] = std::max(result[k], 1e-3 * (path.maxCoeff() - path.minCoeff()));
    }
    if (result[k] <= std::numeric_limits<double>::min()) result[k] = 1.0;
  }
  const double root = std::sqrt(mean_step(data.trajectories.front()));
  for (Index k = 0; k < result.size(); ++k)
    if (const auto& sd = state.noise.measurement[static_cast<std::size_t>(k)])
      result[k] = std::hypot(*sd, root * state.noise.disturbance[k]);
  return result;
}

/// Bridges steps that need what was before the record, where no effect has bridged them.
void bridge_unknown_past(const OdeModel& model, LinearisedRecord& record) {
  const Matrix past = unknown_past(model, record);
  if (past.size() == 0) return;
  if (record.bridge.size() == 0) record.bridge = Matrix::Zero(past.rows(), past.cols());
  record.bridge = (record.bridge.array() > 0.0).select(record.bridge, past).eval();
}

/// What was measured, without what the channels add on the present paths.
std::vector<Matrix> corrected_channels(const Assimilation& state, const Dataset& data) {
  std::vector<Matrix> measured;
  for (std::size_t r = 0; r < state.records.size(); ++r)
    measured.push_back(without_channel_terms(data.trajectories[r].states, state.records[r],
                                             state.model.variables(), state.channel_terms));
  return measured;
}

/// Changes of the free coefficients of an equation.
Vector changes_of(const Assimilation& state, Index equation, const Vector& change) {
  std::vector<double> own;
  for (std::size_t j = 0; j < state.free.size(); ++j)
    if (state.free[j].equation == equation) own.push_back(change[static_cast<Index>(j)]);
  return Eigen::Map<const Vector>(own.data(), static_cast<Index>(own.size()));
}

/// What new coefficients predict beyond the path, to first order, so that the records need not
/// be linearised again for them.
/// @param terms of the free coefficients of each equation.
void shift_defects(Assimilation& state, const std::vector<TermValues>& terms,
                   const Vector& change) {
  const Index m = state.noise.states();
  for (std::size_t r = 0; r < state.records.size(); ++r) {
    LinearisedRecord& record = state.records[r];
    for (Index k = 0; k < m; ++k) {
      const TermValues& along = terms[static_cast<std::size_t>(k)];
      if (along.empty()) continue;
      const Vector rate = along[r] * changes_of(state, k, change);
      for (Index i = 0; i < record.steps(); ++i) {
        const Eigen::Map<const Matrix> w(record.response.col(i).data() + 3 * m * k, m, 3);
        record.defect.col(i) += w.lazyProduct(rate.segment<3>(record.grid.begin(i)));
      }
    }
  }
}

/// Everything that is fitted, moved as far as the records determine it.
/// @param size of what directions may be undetermined in.
DeterminedStep step_in_determined(const Matrix& normal, const Vector& right, const Vector& size,
                                  const AssimilationOptions& options) {
  DeterminedStep step = determined_step(normal, right, size, options.units);
  Matrix held = Matrix::Zero(right.size(), options.unseen.cols() + step.held.cols());
  held.topLeftCorner(options.unseen.rows(), options.unseen.cols()) = options.unseen;
  held.rightCols(step.held.cols()) = step.held;
  step.held = std::move(held);
  return step;
}

DeterminedStep full_step(const Matrix& normal, const Vector& right) {
  const Vector scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  const Matrix inverse = solve_symmetric(scaled, Matrix::Identity(right.size(), right.size()));
  return {scale.asDiagonal() * solve_symmetric(scaled, scale.asDiagonal() * right),
          scale.asDiagonal() * inverse * scale.asDiagonal(),
          {}};
}

}  // namespace

bool is_linearised(const Assimilation& state) {
  return std::all_of(state.records.begin(), state.records.end(), [](const auto& record) {
    return record.defect.allFinite() && record.transition.allFinite();
  });
}

std::vector<Matrix> paths_of(const Assimilation& state) {
  std::vector<Matrix> paths;
  for (const LinearisedRecord& record : state.records) paths.push_back(record.path);
  return paths;
}

Assimilation relinearised(const AssimilationTask& task, Assimilation state) {
  const Vector accuracy = accuracy_of(state, task.data);
  for (std::size_t r = 0; r < state.records.size(); ++r) {
    LinearisedRecord& record = state.records[r];
    const Matrix bridge = std::move(record.bridge);
    record = linearise(state.model, task.data.trajectories[r], record.path, accuracy);
    if (record.bridge.size() == 0)
      record.bridge = bridge;
    else if (bridge.size() > 0)
      record.bridge = record.bridge.cwiseMax(bridge);
    bridge_unknown_past(state.model, record);
  }
  state.measured = corrected_channels(state, task.data);
  return state;
}

Assimilation relinearised_in_reach(const AssimilationTask& task, Assimilation state,
                                   const std::vector<Matrix>& before) {
  // A fact of the search: to a sixty-fourth of the step.
  constexpr int kHalvings = 6;
  state = relinearised(task, std::move(state));
  for (int halving = 0; halving < kHalvings && !is_linearised(state); ++halving) {
    for (std::size_t r = 0; r < state.records.size(); ++r)
      state.records[r].path = 0.5 * (state.records[r].path + before[r]);
    state = relinearised(task, std::move(state));
  }
  return state;
}

Assimilation with_noise_and_path(Assimilation state, VarianceFit& variances) {
  constexpr int kIterations = 8;  // of the variances, before the paths move
  SmoothedNoise best =
      variances.run({state.records, state.measured, state.omitted}, state.noise, kIterations);
  state.noise = std::move(best.noise);
  state.curvature = variances.curvature();
  for (std::size_t r = 0; r < state.records.size(); ++r)
    state.records[r].path += best.records[r].deviation;
  return state;
}

Assimilation with_fitted_coefficients(const AssimilationTask& task, Assimilation state) {
  const AssimilationOptions& options = task.options;
  const InnovationSystem system(state);
  state.deviance = system.deviance();
  state.used = system.used();
  const std::vector<TermValues> terms = system.free_terms();
  const Matrix columns = system.fitted_columns(terms);
  if (columns.cols() == 0) return state;
  Matrix normal = columns.transpose() * columns;
  Vector right = columns.transpose() * system.innovations();
  add_priors(state, options.priors, normal, right);
  DeterminedStep step =
      options.held_among > 0
          ? step_in_determined(normal, right, sizes_of(state, options.held_among), options)
          : full_step(normal, right);
  state.covariance = std::move(step.covariance);
  if (options.held_among > 0) {
    state.held = std::move(step.held);
    state.units = options.units;
  }
  const Vector& change = step.change;
  if (!change.allFinite()) return state;
  state.deviance -= change.dot(right);
  const auto free = static_cast<Index>(state.free.size());
  shift_defects(state, terms, change.head(free));
  state.model = with_coefficients(state.model, state.free, change);
  for (std::size_t j = 0; j < state.channel_terms.size(); ++j)
    state.channel_terms[j].coefficient += change[free + static_cast<Index>(j)];
  state.measured = corrected_channels(state, task.data);
  return state;
}

}  // namespace lacuna
