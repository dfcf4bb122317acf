// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// A number of two records beside one another.
struct AttractorMeasure {
  std::string name;  ///< "extent of x", "spectrum", "density", "Lyapunov exponent"
  std::string unit = {};
  double first = 0.0, second = 0.0;  ///< of a distance: within the records, between them
  double first_half = 0.0, second_half = 0.0;  ///< of their 95 % intervals
  std::optional<bool> agree = {};              ///< nothing where it cannot be judged
  std::string note = {};                       ///< why not
  bool left_out = false;                       ///< the deadline came first
};

/// Compares two records of one system as orbits of one attractor. Every record is cut into five
/// blocks of equal length, whose scatter gives the intervals (Student's t):
///
/// - extents of each state, and the largest Lyapunov exponent (Rosenstein), agree where they
///   differ by no more than both intervals allow, sqrt(a^2 + b^2);
/// - spectra and densities (Hellinger's distances) agree where blocks of different records are
///   no farther apart than blocks of one record, as far as their scatter shows.
/// @throws ArgumentError when the states differ or records are too short for blocks; DataError
///   as check_number_range(); OutOfTime where the deadline passes before the extents, else it
///   leaves measures out; Cancelled.
std::vector<AttractorMeasure> compare_attractors(const Dataset& a, const Dataset& b,
                                                 const RunContext& context = {});

}  // namespace lacuna
