// SPDX-License-Identifier: MIT
// Where a search starts beside the explanation so far, when states are hidden.
#pragma once

#include <optional>
#include <vector>

#include "diagnose/search/rank.hpp"

namespace lacuna {

/// The nominal model on the records with no disturbance at all, its coefficients fitted: what
/// separates it from the records is what is missing, carried on by the model, and noise. No
/// hidden path takes the place of anything; where the model cannot be carried along the whole
/// record the deviance is not finite.
Assimilation undisturbed(const Problem& problem, const Baseline& base);

/// A start, and the equation of which candidates are looked at; none: all.
struct SearchStart {
  std::optional<Index> equation;
  Assimilation fit;
};

/// Where states are hidden and no effect is there yet: undisturbed(), and disturbed_alone() for
/// each equation. None where all is measured.
std::vector<SearchStart> search_starts(const EffectSearch& search, const Explanation& current);

}  // namespace lacuna
