// SPDX-License-Identifier: MIT
// From fitted forms to the effects of the answer.
#pragma once

#include <string>
#include <vector>

#include "diagnose/search/rank.hpp"
#include "lacuna/diagnose/hypotheses/composite_model.hpp"

namespace lacuna {

/// The form of a fitted effect with its numbers.
std::string term_of(const FittedEffect& effect);

/// Gives an effect of the answer one of the names of its form, with the sentence, the cause and
/// what the name calls the shape parameters.
void take_name(const FittedEffect& fitted, const Name& name, NamedEffect& named);

/// The effect of the answer: leading name, significance, other names and other forms.
NamedEffect name_effect(const RankedEffect& ranked, const Ranking& ranking);

/// An effect in another form, with its name.
struct OtherForm {
  NamedEffect named;
  FittedEffect effect;
};

/// The forms in a ranking that are plainer than one of them (fewer shape parameters and memory
/// states, then a shallower formula), significant and of the size of effects; plainest first.
std::vector<OtherForm> plainer_forms(const RankedEffect& ranked, const Ranking& ranking,
                                     const DecisionOptions& decision);

/// The forms in a ranking that stand in another equation, or on a channel, and that the records
/// do not distinguish from one of them (DecisionOptions::undecided).
std::vector<OtherForm> forms_elsewhere(const RankedEffect& ranked, const Ranking& ranking,
                                       const DecisionOptions& decision);

}  // namespace lacuna
