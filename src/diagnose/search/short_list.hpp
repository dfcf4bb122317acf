// SPDX-License-Identifier: MIT
// Which candidates of a round are fitted at all.
#pragma once

#include <memory>
#include <vector>

#include "diagnose/candidates/screening.hpp"
#include "diagnose/search/rank.hpp"

namespace lacuna {

/// A candidate of a short list, and where its fit starts if not from the explanation so far.
struct Listed {
  ScreenedCandidate screened;
  std::shared_ptr<const Assimilation> start = nullptr;
};

/// Candidates that are to be fitted, and how many were screened.
struct ShortList {
  std::vector<Listed> candidates;
  /// Forms of the same effect and argument as one of these, which screening puts behind it:
  /// they are fitted where that one is the best.
  std::vector<ScreenedCandidate> siblings = {};
  Index screened = 0;
  Index tried = 0;  ///< with all shapes
};

/// Whether two candidates are forms of one argument that the same effect proposes.
bool are_siblings(const Candidate& a, const Candidate& b);

/// The best of each family and equation in the order of a screening: those that may be
/// significant and that are not far behind the best, whose lead only grows by an exact fit.
/// @param at_least so many whatever they gain: where a disturbance takes the place of what is
///   missing along a hidden path, only the order says something.
std::vector<ScreenedCandidate> worth_fitting(const std::vector<ScreenedCandidate>& screened,
                                             const DecisionOptions& decision, int at_least);

/// Without a path to go along the best of a screening (score tests) of all candidates; where
/// states are hidden along search_starts(), too. Along the path of an explanation all functions
/// of its arguments.
ShortList short_list(const EffectSearch& search, const Explanation& current);

}  // namespace lacuna
