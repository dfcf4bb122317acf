// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/hypotheses/hypothesis.hpp"

namespace lacuna {

inline constexpr StageInfo kNamedEffects{
    "named-effects", "Effects that the nominal model lacks, one after another", ""};

/// Adds effects one after another, the best of all candidates in each round, as long as they
/// are significant and of the size of effects; those that later ones make superfluous are taken
/// out again.
class NamedEffects final : public Configured<Hypothesis, HypothesisOptions<kNamedEffects>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Effects; }
  Proposals do_propose(const Problem& problem, const Account& best) const override;
};

/// What a search over effects came to.
struct SearchedAccount {
  Account account;
  std::vector<Rival> rivals;  ///< candidates of all rounds, taken or not
};

/// The account of a baseline with the effects that a search finds on top.
/// @param effects that are tried.
SearchedAccount searched(const Problem& problem, std::shared_ptr<const Baseline> base,
                         const std::vector<Stage<Effect>>& effects);

}  // namespace lacuna
