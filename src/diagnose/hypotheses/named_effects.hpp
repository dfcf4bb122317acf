// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

namespace lacuna {

inline constexpr StageInfo kNamedEffects{
    "named-effects", "Effects that the nominal model lacks, one after another", ""};

/// Adds effects one after another, the best of all candidates in each round, as long as they
/// are significant and of the size of effects; those that later ones make superfluous are taken
/// out again.
class NamedEffects final : public Configured<Hypothesis, NoOptions<kNamedEffects>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Effects; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

inline constexpr StageInfo kOtherChoices{
    "other-choices", "Effects that are found when a special form is not there to be chosen",
    ""};

/// Where anything is left beside the effects (has_residual_structure()) their first choices may
/// have been wrong: they are sought again without each of the forms with shapes or memory in
/// turn. Where states are hidden they are sought again among the functions of their arguments,
/// along the path that they have led to, whether anything is left or not: a wrong form may have
/// been all that showed along the first path. The best of these searches takes the place of the
/// first when the records are explained better beyond doubt, or as well with fewer parameters,
/// and what lasts in windows is not more by what counts: between samples a chain of terms may
/// do better than one form that is true but for the last digits.
class OtherChoices final : public Configured<Hypothesis, NoOptions<kOtherChoices>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Revision; }
  int do_order() const override { return -1; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

/// What a search over effects came to.
struct SearchedComposite {
  CompositeModel composite;
  std::vector<Rival> rivals;  ///< candidates of all rounds, taken or not
};

/// The composite model of a baseline with the effects that one search finds on top.
/// @param effects that are tried.
SearchedComposite searched(const Problem& problem, std::shared_ptr<const Baseline> base,
                           const std::vector<Stage<Effect>>& effects);

}  // namespace lacuna
