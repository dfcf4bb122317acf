// SPDX-License-Identifier: MIT
// The recursion of the filter, one sample at a time; what it leaves behind is the caller's.
#pragma once

#include <vector>

#include "lacuna/innovation/linearised_record.hpp"
#include "lacuna/innovation/noise_model.hpp"

namespace lacuna {

/// Which states are measured and where their coloured noise sits.
struct ChannelMap {
  Index size = 0;  ///< N
  std::vector<Index> state;
  std::vector<Index> colour;  ///< N where there is none
  std::vector<double> decay;  ///< of colour states, in one mean step

  ChannelMap(const LinearisedRecord& record, const NoiseModel& noise);
  Index channels() const { return static_cast<Index>(state.size()); }
};

/// One scalar measurement as the filter saw it.
struct Innovation {
  double value = 0.0;     ///< nu
  double variance = 0.0;  ///< S
};

/// Mean and covariance of the deviation, carried along a record.
class KalmanStep {
 public:
  KalmanStep(const LinearisedRecord& record, const NoiseModel& noise, const ChannelMap& map);

  /// Takes in what was measured (minus the path) on one channel. The gain is left in gain().
  Innovation update(Index channel, double measured);

  /// Goes over step i of the record.
  void predict(Index i);

  const Vector& mean() const { return mean_; }
  const Matrix& covariance() const { return covariance_; }
  const Vector& gain() const { return gain_; }

 private:
  void add_disturbance(Index i);

  const LinearisedRecord& record_;
  const ChannelMap& map_;
  Index m_;
  Vector white_;        ///< variance per channel
  Vector colour_;       ///< variance per colour state
  Vector disturbance_;  ///< spectral density per equation
  Vector mean_, next_, gain_, row_;
  Matrix covariance_, half_, transition_;
};

/// Spectral density of the disturbance of an equation in step i: `density`, or that of the
/// bridge where it is larger.
double density_in(const LinearisedRecord& record, Index i, Index equation, double density);

/// Response at the end of step i to a constant rate in an equation: w0 + w1 + w2.
void constant_response(const LinearisedRecord& record, Index i, Index equation, double* out);

}  // namespace lacuna
