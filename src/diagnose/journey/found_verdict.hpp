// SPDX-License-Identifier: MIT
// The verdict that a search and other records come to, before admit().
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "answer.hpp"

namespace lacuna {

/// What a composite model comes to.
struct FoundVerdict {
  Verdict alone = Verdict::NoDiscrepancy;    ///< by the records that were used
  Verdict verdict = Verdict::NoDiscrepancy;  ///< by the others too
  std::vector<std::string> doubts = {};      ///< what is against names, and notes on the gap
  std::optional<Gap> gap = {};
  /// Fitted coefficients beside what has no name make other records worse: they make up for it
  /// in the records that were used, and the model and its gap are those that were given.
  bool stays_as_given = false;
};

/// The verdict of the records that were used and of the others: what stays open there is
/// structure that has no name, whatever those that were used show.
FoundVerdict found_verdict(const Problem& problem, const Judged& judged, std::optional<Gap> gap,
                           const HoldoutEvaluation& evaluation);

}  // namespace lacuna
