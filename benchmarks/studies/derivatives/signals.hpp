// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna::benchmarks {

/// A signal with its exact rate.
struct Signal {
  std::string name;
  double length = 1.0;  ///< of the record, time units

  /// n x 2: values and rates at given times, which begin at 0.
  std::function<Matrix(const Vector& time)> at;
};

/// The twelve signals of the study, chosen before any method was tuned on them: smooth and
/// periodic (sine, two tones), of changing frequency (chirp, damped), with a fast stretch (step,
/// pulses, van der Pol), with kinks (triangle), slow growth (logistic), chaotic (Lorenz, Rossler,
/// Chua). Differential equations are integrated with tolerance 1e-12.
const std::vector<Signal>& signals();

}  // namespace lacuna::benchmarks
