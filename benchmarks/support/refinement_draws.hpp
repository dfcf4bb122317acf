// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/types.hpp"

namespace lacuna::benchmarks {

/// One system at one noise level.
struct RefinementCondition {
  std::string system;  ///< a test system
  Index samples = 1000;
  double noise = 0.01;  ///< share of each state's standard deviation
};

/// What refinement made of one draw of the noise; the structure is given, the coefficients
/// start 10 % off.
struct RefinementDraw {
  bool converged = false;
  Vector errors;           ///< estimate - truth
  Vector standard_errors;  ///< as reported
  Vector half_widths;      ///< of the 95 % intervals
  Vector bound;            ///< Cramer-Rao, at the truth, for the windows that were used
  Vector whole_bound;      ///< the same for the whole record as one window
  double seconds = 0.0;
  bool fits_to_noise = false;
};

/// All draws of one condition.
struct RefinementCell {
  RefinementCondition condition;
  std::vector<RefinementDraw> draws;
};

/// Five systems at 0.1, 1 and 5 % noise.
std::vector<RefinementCondition> refinement_conditions();

/// Refines `draws` seeded draws of each condition on all cores; the result does not depend on
/// their number.
std::vector<RefinementCell> run_refinements(int draws);

}  // namespace lacuna::benchmarks
