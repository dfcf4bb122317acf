// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/named_effects.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "diagnose/criterion/shape_bounds.hpp"
#include "diagnose/search/search.hpp"
#include "diagnose/search/window_refit.hpp"
#include "trajectories/windows/window_gap.hpp"

namespace lacuna {

namespace {

/// What else the records allow, as far as there is time to ask.
std::vector<Twin> rivals_in_time(const EffectSearch& search, const FoundEffects& found) {
  try {
    return rivals_elsewhere(search, found);
  } catch (const OutOfTime&) {
    return {};
  }
}

/// An explanation whose coefficients hold over windows, where there is time for it.
std::optional<Explanation> refitted_in_time(const EffectSearch& search,
                                            const CompositeModel& composite) {
  try {
    return refit_over_windows(search.problem, *composite.base, composite.explanation);
  } catch (const OutOfTime&) {
    return std::nullopt;
  }
}

SearchedComposite composite_of(const EffectSearch& search, std::shared_ptr<const Baseline> base,
                               FoundEffects found) {
  const Problem& problem = search.problem;
  std::vector<Twin> twins = rivals_in_time(search, found);
  SearchedComposite result{{.hypothesis = std::string(kNamedEffects.name),
                            .base = std::move(base),
                            .explanation = std::move(found.explanation),
                            .named = std::move(found.named),
                            .rounds = std::move(found.rounds),
                            .left = std::move(found.left)},
                           std::move(found.rivals)};
  CompositeModel& composite = result.composite;
  composite.twins = std::move(twins);
  if (!composite.named.empty() && leaves_structure(composite, problem.options.decision))
    composite.refitted = refitted_in_time(search, composite);
  return result;
}

/// The composite model of a search beside the best so far, whose assumptions it shares.
Proposals proposed(const EffectSearch& search, const CompositeModel& best, FoundEffects found,
                   double lead) {
  SearchedComposite result = composite_of(search, best.base, std::move(found));
  Proposal proposal{.composite = std::move(result.composite), .judged = ByCriterion{lead}};
  proposal.composite.findings = best.findings;
  proposal.composite.notes = best.notes;
  return {{std::move(proposal)}, std::move(result.rivals)};
}

/// Candidates with shapes or memory among effects that may stand for what is missing, each once:
/// all of them where something is left, else those whose time ended where its range does.
std::vector<Candidate> doubted_forms(const Problem& problem, const CompositeModel& best) {
  const bool leaves = has_residual_structure(best.left, problem.options.decision);
  const std::string& unit = problem.nominal.time_unit();
  std::vector<Candidate> result;
  for (const FittedEffect& effect : best.explanation.effects) {
    const Candidate& candidate = effect.candidate;
    const bool is_new = std::none_of(result.begin(), result.end(), [&](const Candidate& other) {
      return are_one_form(other, candidate);
    });
    const bool is_doubted = leaves || time_on_bound(effect, unit).has_value();
    if (candidate.intricacy() > 0 && is_new && is_doubted) result.push_back(candidate);
  }
  return result;
}

/// Searches that may come to other effects than the best composite model: among plain forms
/// alone and without the first, for two of them may be the truth of which one that lies between
/// explains most by itself, where they take no more numbers; without each of its
/// special forms that may stand for what is missing; where states are hidden, among all
/// functions of the arguments that it has, along its path, which is nearer to the truth than
/// the one from which its forms were chosen.
std::vector<EffectSearch> other_searches(const EffectSearch& search,
                                         const CompositeModel& best) {
  std::vector<EffectSearch> others;
  std::vector<Candidate> all_doubted = doubted_forms(search.problem, best);
  if (!all_doubted.empty()) {
    others.push_back(search);
    others.back().only_plain = true;
    const Candidate& first = best.explanation.effects.front().candidate;
    if (first.intricacy() == 0) others.back().without.push_back(first);
  }
  for (Candidate& doubted : all_doubted) {
    others.push_back(search);
    others.back().without.push_back(std::move(doubted));
  }
  const bool remembers =
      best.explanation.fit.model.dimension() > search.problem.nominal.dimension();
  if (search.base.fit_options.hidden.empty() || remembers) return others;
  others.push_back(search);
  others.back().along = &best.explanation;
  return others;
}

}  // namespace

SearchedComposite searched(const Problem& problem, std::shared_ptr<const Baseline> base,
                           const std::vector<Stage<Effect>>& effects) {
  const EffectSearch search{problem, *base, effects};
  return composite_of(search, std::move(base), search_effects(search));
}

Proposals NamedEffects::do_propose(const Problem& problem, const CompositeModel& best) const {
  const EffectSearch search{problem, *best.base, problem.options.effects};
  return proposed(search, best, search_effects(search), 0.0);
}

Proposals OtherChoices::do_propose(const Problem& problem, const CompositeModel& best) const {
  const DecisionOptions& decision = problem.options.decision;
  if (best.named.empty()) return {};
  const EffectSearch search{problem, *best.base, problem.options.effects};
  std::vector<Rival> trail;
  std::optional<FoundEffects> most;
  double least = criterion_of(problem, *best.base, best.explanation);
  double lead = 0.0;
  const double gap = window_gap(best.explanation.fit);
  for (const EffectSearch& other : other_searches(search, best)) {
    FoundEffects next = search_effects(other);
    std::move(next.rivals.begin(), next.rivals.end(), std::back_inserter(trail));
    next.rivals.clear();
    const Index more = next.explanation.parameters() - best.explanation.parameters();
    if (other.only_plain && more > 0) continue;
    const bool is_plainer = more < 0;
    const double needed = is_plainer ? -decision.undecided : decision.undecided;
    const double value = criterion_of(problem, *best.base, next.explanation) + needed;
    if (next.named.empty() || !(value < least)) continue;
    if (window_gap(next.explanation.fit) > (1.0 + decision.minor) * gap) continue;
    least = value;
    lead = needed;
    most = std::move(next);
    if (!has_residual_structure(most->left, decision)) break;
  }
  if (!most) return {{}, std::move(trail)};
  Proposals result = proposed(search, best, std::move(*most), lead);
  std::move(result.trail.begin(), result.trail.end(), std::back_inserter(trail));
  result.trail = std::move(trail);
  return result;
}

}  // namespace lacuna
