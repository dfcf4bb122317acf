// SPDX-License-Identifier: MIT
// What a model and records are fitted with besides the equations: coefficients that are free
// and what is known of them, noise of the measurement, disturbances.
#pragma once

#include <optional>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// A coefficient of a model by its place.
struct CoefficientPlace {
  Index equation = 0;
  Index term = 0;

  bool operator==(const CoefficientPlace&) const = default;
};

/// What is known beforehand about a coefficient: mean and standard deviation.
struct CoefficientPrior {
  CoefficientPlace place;
  double mean = 0.0;
  double deviation = 0.0;
};

/// Measurement noise with a memory: an Ornstein-Uhlenbeck process that is added to a channel.
struct ColouredNoise {
  double deviation = 0.0;  ///< standard deviation, unit of the state
  double time = 0.0;       ///< correlation time, time units
};

/// What separates a model from a record besides coefficients: noise of the measurement and
/// disturbances of the dynamics.
struct NoiseModel {
  /// Standard deviation of white measurement noise per state; nothing for a state that is not
  /// measured.
  std::vector<std::optional<double>> measurement;

  /// Noise with a memory in the measurement per state, where there is some.
  std::vector<std::optional<ColouredNoise>> coloured;

  /// sqrt of the spectral density of a white disturbance of each equation, state unit per sqrt
  /// of time unit: the disturbance moves a state by disturbance x sqrt(T) in the time T. 0: the
  /// equation holds exactly.
  Vector disturbance;

  /// Per state the spacing of the lattice on which its values are, where it is coarser than
  /// their noise; 0 or missing where it is not. A sample then says in which interval the value
  /// lay before it was rounded, and `measurement` is the noise before that.
  std::vector<double> lattice = {};

  Index states() const noexcept { return disturbance.size(); }  ///< m
  Index measured() const noexcept;  ///< number of states that are measured

  /// Spacing of the lattice of a state; 0 where there is none that counts.
  double lattice_of(std::size_t state) const noexcept {
    return state < lattice.size() ? lattice[state] : 0.0;
  }

  /// Standard deviation of noise and rounding of a measured state together: rounding to a
  /// lattice of spacing q has q / sqrt(12).
  double rounded(std::size_t state) const noexcept;
};

/// How large the residual of one equation is: its disturbance.
struct EquationStructure {
  Index equation = 0;
  double drop = 0.0;      ///< of the deviance when the equation may be disturbed
  double sigma = 0.0;     ///< significance of that
  double rms = 0.0;       ///< of the smoothed disturbance, state unit per time unit
  double relative = 0.0;  ///< rms over that of the state's rate of change
};

/// A standard deviation of a noise model that is fitted.
struct NoiseEntry {
  enum class Kind { Disturbance, White, Coloured } kind = Kind::Disturbance;
  Index state = 0;

  bool operator==(const NoiseEntry&) const = default;
};

/// Inverse of the curvature of the deviance over the logarithms of fitted deviations, as far as
/// it is known: 0 x 0 when it is not.
struct NoiseCurvature {
  std::vector<NoiseEntry> entries;
  Matrix inverse;
};

}  // namespace lacuna
