// SPDX-License-Identifier: MIT
// Once round the loop: an old record, a plan, a new record, a decision.
#pragma once

#include <cstdint>
#include <vector>

#include "pairs.hpp"

namespace lacuna::benchmarks {

/// Experiments of equal cost that are compared, in the order of LoopOutcome::decided.
inline constexpr const char* kExperiments[] = {"plan",      "random steps", "PRBS",
                                               "multisine", "old input again"};

/// What one draw of a case gave.
struct LoopOutcome {
  double old_margin = 0.0;  ///< log Bayes factor of the right model over the best rival, old record
  std::vector<double> margins;  ///< the same with each experiment added
  double promised = 0.0, obtained = 0.0;  ///< log Bayes factor of the planned run alone
  double seconds = 0.0;                   ///< of the plan
  /// Of the right model's numbers after the planned run: half width obtained over promised.
  std::vector<double> widths;
  int covered = 0, intervals = 0;  ///< promised intervals about refitted numbers, with the truth
};

/// @param draw decides which model is right, its parameters (20 % off) and the noise (1 % of the
///   deviation of the old record).
LoopOutcome go_round(const RivalCase& rivals, std::uint64_t draw);

}  // namespace lacuna::benchmarks
