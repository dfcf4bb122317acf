// SPDX-License-Identifier: MIT
#include "hidden/support/reality.hpp"

#include <cmath>

#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"

namespace lacuna::hidden {
namespace {

bool is_shown(const OdeModel& model, const Dataset& record) {
  return model.dimension() == record.state_count() && model.compile().delays().empty();
}

/// One window from its clean start; nothing when it diverges.
std::optional<Matrix> simulated(const OdeModel& model, const Trajectory& clean, Index first,
                                Index count) {
  RecordInput inputs(clean, model.inputs());
  const Solution solution =
      simulate(DrivenModel{model, inputs, inputs.breaks()}, Rk4{{.substeps = 4}},
               clean.states.row(first).transpose(), clean.time.segment(first, count));
  if (solution.status != IntegrationStatus::Completed) return std::nullopt;
  return solution.states;
}

}  // namespace

std::optional<double> real_gap(const OdeModel& model, const Dataset& clean,
                               const Dataset& measured, const Gap& gap) {
  if (!is_shown(model, measured)) return std::nullopt;
  const Trajectory& truth = clean.trajectories.at(0);
  const Matrix& seen = measured.trajectories.at(0).states;
  const Index samples = truth.samples();
  const auto length = std::min(
      samples, static_cast<Index>(std::lround(gap.window / (truth.time[1] - truth.time[0]))));
  Vector square = Vector::Zero(seen.cols());
  double count = 0.0;
  for (Index first = 0; first + length <= samples; first += length) {
    const auto run = simulated(model, truth, first, length);
    if (!run) return std::nullopt;
    const auto here = truth.states.middleRows(first, length);
    square += (here - *run).colwise().squaredNorm().transpose();
    square += (seen.middleRows(first, length) - here).colwise().squaredNorm().transpose();
    count += static_cast<double>(length);
  }
  const Vector variance =
      (seen.rowwise() - seen.colwise().mean()).colwise().squaredNorm().transpose() /
      static_cast<double>(samples);
  return std::sqrt((square / count).cwiseQuotient(variance).mean());
}

std::optional<double> true_gap(const HiddenCase& hidden, const Dataset& measured) {
  if (!hidden.augmented || !is_shown(*hidden.augmented, measured)) return std::nullopt;
  Explanation truth{{}, {*hidden.augmented}};
  return measure_gap(hidden.nominal, truth, {as_measured(measured), measured}, RunContext{})
      .after;
}

}  // namespace lacuna::hidden
