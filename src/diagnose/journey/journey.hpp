// SPDX-License-Identifier: MIT
// The part of a diagnosis that chooses between accounts of the records.
#pragma once

#include <vector>

#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

namespace lacuna {

/// The best account and the trail of all that were judged.
struct Judged {
  Account best;
  std::vector<Rival> trail = {};
};

/// Hypotheses of one phase in order, each against the best account so far.
/// @param hypotheses as in_order() has them.
Judged judge_phase(const Problem& problem, const std::vector<Stage<Hypothesis>>& hypotheses,
                   Hypothesis::Phase phase, Judged so_far);

/// The account of what is missing that comes first, under the plain assumptions.
Judged first_account(const Problem& problem, const std::vector<Stage<Hypothesis>>& hypotheses,
                     Baseline base);

/// What else may be in the place of the first account, then accounts under other assumptions,
/// on top of which the effects are sought again.
Judged choose_account(const Problem& problem, const std::vector<Stage<Hypothesis>>& hypotheses,
                      Judged first);

/// What an account may claim: names that leave structure and do not explain most are withdrawn;
/// beside structure that is left, coefficients are those that hold over windows; what is left
/// is described.
Judged settle_account(const Problem& problem, const std::vector<Stage<Hypothesis>>& hypotheses,
                      Judged so_far);

/// The account of the same baseline without any name.
Account without_names(const Problem& problem, const Account& account);

/// An account of which other records refuted what it names: without its effects, or where only
/// assumptions have names the one of the plain baseline.
Account without_claims(const Problem& problem, const Account& account);

}  // namespace lacuna
