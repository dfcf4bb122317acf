// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "support/cells.hpp"

namespace lacuna::benchmarks {

/// One system at one noise level.
struct RefinementCondition {
  std::string system;  ///< a test system
  Index samples = 1000;
  double noise = 0.01;  ///< fraction of each state's standard deviation
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

  auto fields() {
    return std::tie(converged, errors, standard_errors, half_widths, bound, whole_bound,
                    seconds, fits_to_noise);
  }
};

/// All draws of one condition.
struct RefinementDraws {
  RefinementCondition condition;
  std::vector<RefinementDraw> draws;
};

/// Five systems at 0.1, 1 and 5 % noise.
std::vector<RefinementCondition> refinement_conditions();

/// All draws of all conditions.
struct Refinements {
  std::vector<RefinementDraws> conditions;
  Origin origin;
};

/// Refines `draws` seeded draws of each condition, each draw a cell.
/// @return nothing where other processes have not finished their cells. @throws as run_cells().
std::optional<Refinements> run_refinements(const CellStore& store, std::size_t draws);

}  // namespace lacuna::benchmarks
