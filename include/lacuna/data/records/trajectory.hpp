// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// One uninterrupted record: n samples of m states and p inputs at strictly increasing times.
struct Trajectory {
  std::string source;  ///< where it comes from, for messages: "run.csv", "run.csv, record 2"
  Vector time;         ///< n, in the time unit of the dataset
  Matrix states;       ///< n x m
  Matrix inputs;       ///< n x p; n x 0 without inputs
  Matrix derivatives;  ///< n x m, dx/dt at the samples; 0 x 0 when they are not known
  Matrix marks = {};   ///< n x m, what each sample shows of its state (Mark); 0 x 0: its value

  /// Number of samples n.
  Index samples() const noexcept { return time.size(); }

  /// Whether dx/dt came with the data.
  bool has_derivatives() const noexcept { return derivatives.size() > 0; }

  /// Time from the first sample to the last; there must be one.
  double duration() const noexcept { return time[time.size() - 1] - time[0]; }
};

/// Mean of the sampling steps.
/// @throws ArgumentError when there are fewer than two samples or it is not a finite number.
double mean_step(const Trajectory& trajectory);

/// The common sampling step of a record.
/// @return nothing when steps differ by more than `tolerance` times the mean step, when there
/// are
///   fewer than two samples, or when times are not finite.
std::optional<double> uniform_step(const Trajectory& trajectory, double tolerance = 1e-3);

/// Samples [first, first + count) of a record.
/// @throws ArgumentError when they are not there, or the record has not as many rows as times.
Trajectory rows_of(const Trajectory& trajectory, Index first, Index count);

/// File that a record comes from: "run.csv" of "run.csv, record 2".
std::string file_of(const Trajectory& trajectory);

/// Whether a piece goes on where another one of the same record ("run.csv, piece 1") ends, as
/// after missing samples: it begins later, by `longest_gap` at most. A record with a number of
/// its own ("run.csv, record 2") goes on from no other, and nothing from or to no samples.
bool goes_on(const Trajectory& before, const Trajectory& after, double longest_gap);

}  // namespace lacuna
