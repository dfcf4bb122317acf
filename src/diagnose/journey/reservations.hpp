// SPDX-License-Identifier: MIT
// Why an explanation does not pass as plainly explained.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/journey/gap.hpp"
#include "lacuna/diagnose/hypotheses/composite_model.hpp"

namespace lacuna {

/// What there is to be said against a composite model that leaves no structure, a sentence
/// each; none where names and numbers are as they should be. Said are: a gap on other records
/// that stays above its noise floor (DecisionOptions::explained_gap) by more than chance, also
/// where nothing is named, equations_turned_off(), also there, a shape on the bound of its range,
/// parts that nearly cancel, nominal coefficients of another sign or size, effects that act in few
/// samples only, and effects of an input of which most samples were put on lines between others.
std::vector<std::string> reservations(const Problem& problem, const CompositeModel& composite,
                                      const std::optional<Gap>& gap);

/// Hidden states of which the fit turned the equation off: every coefficient is smaller by more
/// than DecisionOptions::out_of_scale. What held the state still (a stop, a valve, a melting
/// store) is not in the model then, and a constant in the place of the state meets the records.
std::vector<Index> equations_turned_off(const Problem& problem,
                                        const CompositeModel& composite);

/// Whether the gap stays above its floor by more than the decision allows, and not by chance:
/// by significantly many of its standard errors, or by more than DecisionOptions::open_gap.
bool stays_open(const Gap& gap, const DecisionOptions& decision);

/// Whether the augmented model, run freely over whole records, is farther off than the decision
/// allows (DecisionOptions::diverging).
bool runs_away(const Gap& gap, const DecisionOptions& decision);

}  // namespace lacuna
