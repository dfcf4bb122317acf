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

}  // namespace

StageSignals empty_stage_signals(const StepScheme& scheme, Index samples, Index signals) {
  const Index steps = samples * scheme.substeps;
  return {scheme, Vector::Zero(steps),
          std::vector<Matrix>(static_cast<std::size_t>(scheme.tableau->stages()),
                              Matrix::Zero(steps, signals))};
}

DrivingSignals::DrivingSignals(const DrivingSamples& samples) : time_(samples.time) {
  std::size_t column = 0;
  const auto next = [&] {
    return samples.signals.empty() ? Interpolation::Cubic : samples.signals[column++];
  };
  for (Index j = 0; j < samples.inputs.cols(); ++j)
    inputs_.emplace_back(time_, samples.inputs.col(j), next());
  for (Index j = 0; j < samples.delayed.cols(); ++j) {
    const Interpolation between = next();
    delayed_.push_back({SampledSignal(time_, samples.delayed.col(j), between),
                        samples.delays[static_cast<std::size_t>(j)],
                        between == Interpolation::Held, samples.affine});
  }
}

void DrivingSignals::at(const SpanOfTime& span, double fraction, double* signals,
                        Index stride) {
  const double t = span.begin + fraction * span.length;
  const auto write = [&](double value) {
    *signals = value;
    signals += stride;
  };
  for (const SampledSignal& input : inputs_) write(input.in_interval(span.interval, t));
  write(t);
  for (Delayed& delayed : delayed_) {
    const double from = span.begin - delayed.delay;
    if (!delayed.held)
      write(delayed.signal(t - delayed.delay));
    else if (delayed.affine)
      write(delayed.signal.held_moments(from, from + span.length).at(fraction));
    else
      write(delayed.signal.held_line(from, from + span.length).at(fraction));
  }
}

void write_stage_signals(const DrivingSamples& samples, Index first, StageSignals& signals) {
  const Index substeps = signals.scheme.substeps, rows = signals.lengths.size();
  const Vector lengths = step_lengths(samples.time, substeps);
  DrivingSignals driving(samples);
  for (Index i = 0; i < samples.time.size(); ++i)
    for (Index j = 0; j < substeps; ++j) {
      const Index row = (first + i) * substeps + j;
      const SpanOfTime span{i, samples.time[i] + static_cast<double>(j) * lengths[i],
                            lengths[i]};
      signals.lengths[row] = lengths[i];
      for (std::size_t a = 0; a < signals.stages.size(); ++a)
        driving.at(span, signals.scheme.tableau->nodes[a], signals.stages[a].data() + row,
                   rows);
    }
}

}  // namespace lacuna
