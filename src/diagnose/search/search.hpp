// SPDX-License-Identifier: MIT
// The rounds of a search: one effect after another.
#pragma once

#include <vector>

#include "diagnose/search/rank.hpp"
#include "effect_names.hpp"
#include "lacuna/diagnose/hypotheses/composite_model.hpp"

namespace lacuna {

/// Effects that were found, in the order in which they came in.
struct FoundEffects {
  Explanation explanation;
  std::vector<NamedEffect> named = {};               ///< one for each effect of the explanation
  std::vector<std::vector<OtherForm>> plainer = {};  ///< forms that may take their places
  std::vector<Round> rounds = {};
  std::vector<EquationStructure> left = {};  ///< their residual structure
  std::vector<Rival> rivals = {};            ///< candidates of all rounds, taken or not
  /// Per effect, what explained the records as well in its round in another place.
  std::vector<std::vector<OtherForm>> elsewhere = {};
};

/// Adds effects until none is significant and of the size of an effect, or there are enough;
/// effects that later ones make superfluous are taken out again. Where structure is left in the
/// end special forms give way to plain ones that leave hardly more. Names are those of the
/// numbers that the effects have in the end.
FoundEffects search_effects(const EffectSearch& search);

/// What explains the records as well in another place; DecisionOptions::undecided says what is as
/// well.
std::vector<Twin> rivals_elsewhere(const EffectSearch& search, const FoundEffects& found);

}  // namespace lacuna
