// SPDX-License-Identifier: MIT
// Where a model is defined: roots, logarithms and powers along a run.
#pragma once

#include <vector>

#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {

/// Ends of the states, infinite where there is none.
struct StateRanges {
  Vector lower, upper;  ///< m
};

/// The values of each state for which functions of it alone (sqrt(h), sqrt(2*g*h), log(x - 1))
/// are defined.
StateRanges state_ranges(const ParametrisedModel& model);

/// Whether runs stay where the equations and some formulas of a model are defined. Functions of
/// delayed variables are not looked at. One object per thread.
class FitDomain {
 public:
  FitDomain(const ParametrisedModel& model, const std::vector<Expression>& formulas);

  /// Whether the model is defined for all states.
  bool is_everything() const noexcept { return margins_.outputs() == 0; }

  /// A run begins.
  void begin() { largest_.setZero(); }

  /// Whether the model is defined at the next point of the run. Its margins may be below 0 by a
  /// fraction of their largest value so far: integration that lets errors of this size pass
  /// ends on either side of the edge.
  /// @param slots as those of Rates.
  bool holds(const double* slots, double passed);

 private:
  Program margins_;
  Vector values_, largest_;
  Program::Workspace workspace_;
};

}  // namespace lacuna
