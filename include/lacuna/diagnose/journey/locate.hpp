// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/trajectories/smoother/disturbance_test.hpp"

namespace lacuna {

/// A place where an equation and the records disagree.
struct Location {
  std::string variable;  ///< state, input or t; empty for a frequency
  double low = 0.0, high = 0.0;
  std::optional<double> frequency = {};  ///< per time unit
  double sigma = 0.0;
};

/// How far one equation and the records disagree.
struct Disagreement {
  Index equation = 0;
  double rms = 0.0;          ///< rate that has to be added to keep the model on the records
  double noise_floor = 0.0;  ///< the rate that would be significant by one standard deviation
  double sigma = 0.0;
  double fraction = 0.0;        ///< of all disagreement (drops of the deviance)
  double relative = 0.0;        ///< rms over that of the state's rate of change
  std::vector<Location> where;  ///< most significant first
};

/// Where a model and the records it was brought onto disagree: per equation how much, over
/// which range of which variable (a constant rate in the range, ranges between the deciles of
/// the samples), at which frequency.
std::vector<Disagreement> locate(const Assimilation& fit, const RunContext& context);

}  // namespace lacuna
