// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "diagnose/candidates/fit_memory.hpp"
#include "diagnose/candidates/screening.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// White noise that the samples of an input show (0: none), and their standard deviation.
struct InputNoise {
  double noise = 0.0, deviation = 0.0;
};

/// What searches have come to, so that no other one does the same again.
struct SearchMemory {
  FitMemory fits = FitMemory();
  ScreeningMemory screenings = {};
  /// The nominal model with the coefficients of a trajectory fit, where not every state is
  /// measured: from
  /// nominal ones that are far off the linearised fits do not come to them.
  std::optional<OdeModel> start = {};
  /// White noise that the samples of each input show, with their standard deviation.
  std::optional<std::vector<InputNoise>> input_noise = {};
};

}  // namespace lacuna
