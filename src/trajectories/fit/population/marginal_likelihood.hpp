// SPDX-License-Identifier: MIT
// The likelihood of a population, individual values integrated out.
#pragma once

#include <vector>

#include "record_mode.hpp"

namespace lacuna {

/// A population at given values.
struct PopulationState {
  std::vector<RecordMode> modes;  ///< R
  FitPoint point;                 ///< of the modes
  FitPath path;                   ///< of the modes; its cost is not computed
  /// -2 log of the likelihood, and what is known of the typical values before.
  double loss = 0.0;

  double log_likelihood(std::size_t record) const {
    return -0.5 * (modes[record].loss + modes[record].log_determinant);
  }
};

/// Own numbers of all records to start from: initial values as given, deviations 0.
std::vector<Vector> first_guesses(const PopulationProblem& problem, const FitPoint& start);

/// The own numbers of a state.
std::vector<Vector> own_of(const PopulationState& state);

/// The population at given values, by Laplace's approximation about the mode of each record
/// (find_mode()). The engine keeps the sizes of noise.
/// @param guesses own numbers of each record, from which its mode is looked for.
PopulationState population_at(FitEngine& engine, const PopulationProblem& problem,
                              const PopulationValues& values,
                              const std::vector<Vector>& guesses);

/// The values as coordinates without units: logarithms of parameters whose range is above 0,
/// other parameters, spreads, logarithms of sizes.
class PopulationCoordinates {
 public:
  PopulationCoordinates(const PopulationProblem& problem, const PopulationValues& values);

  Vector of(const PopulationValues& values) const;
  PopulationValues values(const Vector& coordinates) const;  ///< spreads by their size alone

  Vector lower() const;  ///< infinite where there is none
  Vector upper() const;

  /// d value / d coordinate at given values.
  Vector slopes(const PopulationValues& values) const;

  bool is_logarithmic(Index global) const {
    return logarithmic_[static_cast<std::size_t>(global)];
  }
  Index size() const { return globals() + spreads() + sizes_; }
  Index globals() const { return static_cast<Index>(problem_.unknowns.global.size()); }
  Index spreads() const { return static_cast<Index>(problem_.varying.size()); }

 private:
  const PopulationProblem& problem_;
  Vector given_;  ///< P
  std::vector<bool> logarithmic_;
  Index sizes_;
};

/// Expected second derivatives of the loss by the coordinates, about: those of the linear model
/// at the modes for typical values, of normal deviations and residuals for spreads and sizes.
Matrix expected_curvature(FitEngine& engine, const PopulationProblem& problem,
                          const PopulationValues& values, const PopulationState& state);

}  // namespace lacuna
