// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "dynamics/integration/butcher_tableau.hpp"
#include "lacuna/core/numerics/sampled_signal.hpp"

namespace lacuna {

/// How sampling intervals are integrated: equal steps of one explicit method.
struct StepScheme {
  const ButcherTableau* tableau = nullptr;
  Index substeps = 1;

  bool operator==(const StepScheme&) const = default;
};

/// Signals (inputs, t, delayed variables) at every stage of every step. Steps of sampling
/// interval i are i * substeps, ...; at the last sample of a trajectory their length is 0.
struct StageSignals {
  StepScheme scheme;
  Vector lengths;              ///< of the steps, N * substeps
  std::vector<Matrix> stages;  ///< per stage: N * substeps x signals
};

/// Signals for N samples, all zero.
StageSignals empty_stage_signals(const StepScheme& scheme, Index samples, Index signals);

/// What was sampled along one trajectory and drives a model.
struct DrivingSamples {
  Vector time;                 ///< n
  Matrix inputs;               ///< n x p
  Matrix delayed;              ///< n x d: the variables that are delayed, without delay
  std::vector<double> delays;  ///< d
  std::vector<Interpolation> signals = {};  ///< of inputs, then delayed; empty: cubic
  bool affine = false;  ///< whether the model is affine in its delayed variables
};

/// A part of a sampling interval.
struct SpanOfTime {
  Index interval = 0;  ///< of the samples
  double begin = 0.0, length = 0.0;
};

/// What drives a model along one trajectory, at any time. Before its first sample that sample
/// holds. A value; not for use from several threads at once.
class DrivingSignals {
 public:
  explicit DrivingSignals(const DrivingSamples& samples);

  /// Samples of the trajectory.
  const Vector& time() const noexcept { return time_; }

  Index size() const noexcept {
    return static_cast<Index>(inputs_.size() + delayed_.size()) + 1;
  }

  /// Inputs, t and delayed variables at a fraction of a span: `size()` values, so far apart. Of
  /// a delayed variable that is held, which jumps inside of spans, it is the parabola of least
  /// squares where the model is affine in it, else the line.
  void at(const SpanOfTime& span, double fraction, double* signals, Index stride = 1);

 private:
  struct Delayed {
    SampledSignal signal;
    double delay;
    bool held, affine;
  };
  Vector time_;
  std::vector<SampledSignal> inputs_;
  std::vector<Delayed> delayed_;
};

/// Writes the signals of one trajectory.
/// @param first its first sample in `signals`.
void write_stage_signals(const DrivingSamples& samples, Index first, StageSignals& signals);

}  // namespace lacuna
