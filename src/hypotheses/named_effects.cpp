// SPDX-License-Identifier: MIT
#include "lacuna/hypotheses/named_effects.hpp"

#include "search.hpp"
#include "window_refit.hpp"

namespace lacuna {

SearchedAccount searched(const Problem& problem, std::shared_ptr<const Baseline> base,
                         const std::vector<Stage<Effect>>& effects) {
  const EffectSearch search{problem, *base, effects};
  FoundEffects found = search_effects(search);
  std::vector<std::string> doubts = rivals_elsewhere(search, found);
  SearchedAccount result{{.hypothesis = std::string(kNamedEffects.name),
                          .base = std::move(base),
                          .explanation = std::move(found.explanation),
                          .named = std::move(found.named),
                          .rounds = std::move(found.rounds),
                          .left = std::move(found.left)},
                         std::move(found.rivals)};
  Account& account = result.account;
  account.doubts = std::move(doubts);
  if (!account.named.empty() && leaves_structure(account, problem.options.decision))
    account.refitted = refit_over_windows(problem, *account.base, account.explanation);
  return result;
}

Proposals NamedEffects::do_propose(const Problem& problem, const Account& best) const {
  SearchedAccount found = searched(problem, best.base, problem.options.effects);
  Proposal proposal{std::move(found.account)};
  proposal.account.findings = best.findings;
  proposal.account.notes = best.notes;
  return {{std::move(proposal)}, std::move(found.rivals)};
}

}  // namespace lacuna
