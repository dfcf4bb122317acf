// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/stage_signals.hpp"

namespace lacuna {
namespace {

/// Length of the steps in each sampling interval; 0 behind the last sample.
Vector step_lengths(const Vector& time, Index substeps) {
  const Index n = time.size();
  Vector lengths = Vector::Zero(n);
  lengths.head(n - 1) = (time.tail(n - 1) - time.head(n - 1)) / static_cast<double>(substeps);
  return lengths;
}

/// Times of the stages: n * substeps x stages.
Matrix stage_times(const Vector& time, const Vector& lengths, const StepScheme& scheme) {
  Matrix times(time.size() * scheme.substeps, scheme.tableau->stages());
  for (Index i = 0; i < time.size(); ++i)
    for (Index j = 0; j < scheme.substeps; ++j)
      for (Index a = 0; a < times.cols(); ++a)
        times(i * scheme.substeps + j, a) =
            time[i] + static_cast<double>(j) * lengths[i] +
            scheme.tableau->nodes[static_cast<std::size_t>(a)] * lengths[i];
  return times;
}

/// A held signal at a share of a step, inside of which it may jump.
double held_value(SampledSignal& signal, double from, double length, double share) {
  return signal.held_line(from, from + length).at(share);
}

}  // namespace

StageSignals empty_stage_signals(const StepScheme& scheme, Index samples, Index signals) {
  const Index steps = samples * scheme.substeps;
  return {scheme, Vector::Zero(steps),
          std::vector<Matrix>(static_cast<std::size_t>(scheme.tableau->stages()),
                              Matrix::Zero(steps, signals))};
}

void write_stage_signals(const DrivingSamples& samples, Index first, StageSignals& signals) {
  const Index substeps = signals.scheme.substeps, p = samples.inputs.cols();
  const Vector lengths = step_lengths(samples.time, substeps);
  const Matrix times = stage_times(samples.time, lengths, signals.scheme);
  const auto column_of = [&](Index stage, Index column) {
    return signals.stages[static_cast<std::size_t>(stage)].col(column).segment(first * substeps,
                                                                               times.rows());
  };
  const auto goes_on = [&](Index column) {
    return samples.signals.empty() ? Interpolation::Cubic
                                   : samples.signals[static_cast<std::size_t>(column)];
  };
  for (Index step = 0; step < times.rows(); ++step)
    signals.lengths[first * substeps + step] = lengths[step / substeps];
  for (Index a = 0; a < times.cols(); ++a) column_of(a, p) = times.col(a);
  for (Index column = 0; column < p; ++column) {
    const SampledSignal input(samples.time, samples.inputs.col(column), goes_on(column));
    for (Index a = 0; a < times.cols(); ++a)
      for (Index step = 0; step < times.rows(); ++step)
        column_of(a, column)[step] = input.in_interval(step / substeps, times(step, a));
  }
  for (Index d = 0; d < samples.delayed.cols(); ++d) {
    const double delay = samples.delays[static_cast<std::size_t>(d)];
    SampledSignal signal(samples.time, samples.delayed.col(d), goes_on(p + d));
    const bool held = goes_on(p + d) == Interpolation::Held;
    for (Index a = 0; a < times.cols(); ++a)
      for (Index step = 0; step < times.rows(); ++step)
        column_of(a, p + 1 + d)[step] =
            held ? held_value(signal, times(step, 0) - delay, lengths[step / substeps],
                              signals.scheme.tableau->nodes[static_cast<std::size_t>(a)])
                 : signal(times(step, a) - delay);
  }
}

}  // namespace lacuna
