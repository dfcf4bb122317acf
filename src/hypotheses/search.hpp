// SPDX-License-Identifier: MIT
// The rounds of a diagnosis: one effect after another.
#pragma once

#include <optional>
#include <vector>

#include "lacuna/hypotheses/account.hpp"

namespace lacuna {

/// What the rounds ended with.
struct SearchResult {
  Explanation explanation;
  std::vector<NamedEffect> named;  ///< one for each effect of the explanation
  std::vector<Round> rounds;
  std::vector<EquationStructure> left;
};

/// Adds effects until none is significant and of the size of an effect, or there are enough;
/// effects that later ones make superfluous are taken out again.
SearchResult search_effects(const Problem& problem, const Baseline& base,
                            const std::vector<Stage<Effect>>& effects);

/// BIC of an explanation.
double criterion_of(const Explanation& explanation);

}  // namespace lacuna
