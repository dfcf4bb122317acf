// SPDX-License-Identifier: MIT
// Whether states stay in their ranges, with a probability.
#pragma once

#include <vector>

#include "evidence.hpp"

namespace lacuna {

/// How far a path goes beyond its ranges, as a fraction of their width (of their finite end
/// where one is open, 1 at least); 0: not at all; infinite for a path that does not stay finite.
double excess_of(const Prediction& prediction, const std::vector<SafeRange>& ranges);

/// The largest excess of the estimates and of draws (R x any number) in an experiment.
double worst_excess(Rivals& rivals, const Experiment& experiment,
                    const std::vector<SafeRange>& ranges,
                    const std::vector<std::vector<PathNumbers>>& draws);

/// Draws of the numbers of each model in an experiment.
struct SafetyCheck {
  double leaves = 0.0;  ///< fraction of the draws that leaves a range, of the worst model
  /// R x any number: of models that leave too often draws that have to stay inside.
  std::vector<std::vector<PathNumbers>> offending;
};

/// @param count draws of each model; @param allowed fraction that may leave.
SafetyCheck check_safety(const Rivals& rivals, const Experiment& experiment,
                         const std::vector<SafeRange>& ranges, int count, double allowed,
                         const RunContext& context);

}  // namespace lacuna
