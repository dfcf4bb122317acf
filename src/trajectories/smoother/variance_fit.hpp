// SPDX-License-Identifier: MIT
// The variances of the largest likelihood on a linearisation as it is.
#pragma once

#include <vector>

#include "lacuna/trajectories/smoother/innovation_filter.hpp"

namespace lacuna {

/// Records that are linearised, with what was measured.
struct LinearisedData {
  const std::vector<LinearisedRecord>& records;
  const std::vector<Matrix>& measured;
  const std::vector<Matrix>& omitted;  ///< one per record, or none
};

/// A noise model with the smoother run under it.
struct SmoothedNoise {
  NoiseModel noise;
  double deviance = 0.0;
  Vector gradient;  ///< of the deviance with the log of each standard deviation in play
  Vector weight;    ///< samples that determine each
  std::vector<SmoothedRecord> records;
  int runs = 0;  ///< of the smoother over the records, until it was found
};

/// Minimises the deviance over the logarithms of the standard deviations of disturbances,
/// coloured and white noise by the BFGS method (Nocedal and Wright, Numerical Optimization
/// (2006), Ch. 6), with the gradient from the smoother's sums: d deviance / d log s = 2 s^2
/// (expected - found). What it has learnt of the curvature is kept for the next linearisation.
class VarianceFit {
 public:
  /// @param floor least standard deviation of white noise per state.
  /// @param known what another fit has learnt of the curvature; used where it was of the same
  /// deviations.
  explicit VarianceFit(Vector floor, NoiseCurvature known = {})
      : floor_(std::move(floor)), known_(std::move(known)) {}

  /// Whether the white noise moves too.
  void set_white_moves(bool moves);

  /// @param iterations at most so many steps.
  SmoothedNoise run(const LinearisedData& data, const NoiseModel& start, int iterations);

  /// What it has learnt of the curvature.
  const NoiseCurvature& curvature() const { return known_; }

 private:
  std::vector<NoiseEntry> entries_of(const NoiseModel& noise) const;
  SmoothedNoise at(const LinearisedData& data, NoiseModel noise) const;
  NoiseModel moved(const NoiseModel& noise, const Vector& step) const;
  void begin_with(const SmoothedNoise& start);
  bool learn(const Vector& step, const Vector& change);

  Vector floor_;
  bool white_moves_ = true;
  NoiseCurvature known_;
};

}  // namespace lacuna
