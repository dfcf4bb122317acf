// SPDX-License-Identifier: MIT
// Which candidates of a round are fitted at all.
#pragma once

#include <memory>
#include <vector>

#include "lacuna/candidates/screening.hpp"
#include "lacuna/hypotheses/rank.hpp"

namespace lacuna {

/// A candidate of a short list, and where its fit starts if not from the explanation so far.
struct Listed {
  ScreenedCandidate screened;
  std::shared_ptr<const Assimilation> start = nullptr;
};

/// Candidates that are to be fitted, and how many were screened.
struct ShortList {
  std::vector<Listed> candidates;
  Index screened = 0;
  Index tried = 0;  ///< with all shapes
};

/// Without a path to go along the best of a screening (score tests) of all candidates; where
/// states are hidden along search_starts(), too. Along the path of an explanation all functions
/// of its arguments.
ShortList short_list(const EffectSearch& search, const Explanation& current);

}  // namespace lacuna
