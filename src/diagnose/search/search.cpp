// SPDX-License-Identifier: MIT
#include "search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/parallel.hpp"
#include "diagnose/criterion/effect_parts.hpp"
#include "diagnose/hypotheses/input_noise.hpp"
#include "diagnose/hypotheses/named_effects.hpp"
#include "effect_shortfall.hpp"
#include "effect_size.hpp"
#include "shared_form.hpp"

namespace lacuna {
namespace {

const DecisionOptions& decision_of(const EffectSearch& search) {
  return search.problem.options.decision;
}

Explanation explain_from(const EffectSearch& search, const Explanation& start,
                         const std::vector<FittedEffect>& effects) {
  return explain_on(search.problem, search.base, start.fit, effects);
}

double criterion_of(const EffectSearch& search, const Explanation& explanation) {
  return criterion_of(search.problem, search.base, explanation);
}

/// Drop of the disturbance variance of an equation, as a fraction of the baseline's.
double drop_of(const EffectSearch& search, const Explanation& before, const Explanation& after,
               Index equation) {
  const auto variance = [&](const Assimilation& fit) {
    return std::pow(fit.noise.disturbance[equation], 2);
  };
  const double first = variance(search.base.fitted);
  return first > 0.0 ? (variance(before.fit) - variance(after.fit)) / first : 0.0;
}

/// Whether all effects have numbers such as they can have, by whatever name.
bool all_named(const EffectSearch& search, const Explanation& explanation) {
  const NameTable table = search.names();
  return std::none_of(explanation.effects.begin(), explanation.effects.end(),
                      [&](const FittedEffect& one) {
                        return table.names_of(one, explanation.fit.model).empty();
                      });
}

FoundEffects without_effect(const EffectSearch& search, FoundEffects found, std::size_t e) {
  const auto place = static_cast<std::ptrdiff_t>(e);
  std::vector<FittedEffect> rest = found.explanation.effects;
  rest.erase(rest.begin() + place);
  found.explanation = explain_from(search, found.explanation, rest);
  found.named.erase(found.named.begin() + place);
  found.plainer.erase(found.plainer.begin() + place);
  found.elsewhere.erase(found.elsewhere.begin() + place);
  return found;
}

/// Takes out the first effect that is not distinguished from 0 any more, if the records are
/// explained no worse without it. @return whether there was one.
bool take_out_one(const EffectSearch& search, FoundEffects& found) {
  for (std::size_t e = 0; e + 1 < found.explanation.effects.size(); ++e) {
    if (ratio_to_error(found.explanation.effects[e]) >= decision_of(search).significance)
      continue;
    FoundEffects smaller = without_effect(search, found, e);
    if (criterion_of(search, smaller.explanation) > criterion_of(search, found.explanation))
      continue;
    found = std::move(smaller);
    return true;
  }
  return false;
}

/// Puts another form in the place of effect `e`.
void take_place(const EffectSearch& search, std::size_t e, NamedEffect named, Explanation next,
                FoundEffects& found) {
  const double drop = drop_of(search, found.explanation, next, named.equation);
  named.gap_closed = std::clamp(found.named[e].gap_closed + drop, 0.0, 1.0);
  found.named[e] = std::move(named);
  found.explanation = std::move(next);
}

/// Whether one of the effects, other than the e-th, has a form already.
bool has_form(const FoundEffects& found, const Candidate& form,
              std::optional<std::size_t> other_than = {}) {
  const std::vector<FittedEffect>& effects = found.explanation.effects;
  for (std::size_t e = 0; e < effects.size(); ++e)
    if (e != other_than && are_one_form(effects[e].candidate, form)) return true;
  return false;
}

/// Another form in the place of an effect. It was found beside fewer effects than there are now:
/// its memory gets names that the others do not have.
Explanation with_form(const EffectSearch& search, const FoundEffects& found, std::size_t e,
                      const FittedEffect& form) {
  std::vector<FittedEffect> effects = found.explanation.effects;
  std::vector<std::string> taken = search.problem.nominal.variables().names();
  for (std::size_t other = 0; other < effects.size(); ++other)
    for (const MemoryState& memory : effects[other].candidate.memory)
      if (other != e) taken.push_back(memory.name);
  effects[e] = form;
  effects[e].candidate = without_clash(form.candidate, taken);
  return explain_from(search, found.explanation, effects);
}

/// Puts a plainer form of its round in the place of an effect.
void settle_for(const EffectSearch& search, std::size_t e, const OtherForm& plainer,
                Explanation next, FoundEffects& found) {
  found.rounds.push_back(
      {1, plainer.named.name + ": " + term_of(plainer.effect), plainer.named.sigma, true});
  take_place(search, e, plainer.named, std::move(next), found);
}

/// Compares the form of an effect with the plainer ones of its round once more, where the
/// effects beside which it was chosen are not the same any more: the best of these takes its
/// place unless it is worse beyond doubt.
void compare_again(const EffectSearch& search, std::size_t e, FoundEffects& found) {
  std::vector<OtherForm> plainer = found.plainer[e];
  std::erase_if(plainer, [&](const OtherForm& form) {
    return has_form(found, form.effect.candidate, e);
  });
  std::vector<std::optional<Explanation>> fits(plainer.size());
  const RunContext& context = search.problem.context;
  const RunContext quiet = context.beside_others();
  const Problem problem = alone(search.problem, quiet);
  const EffectSearch each{problem, search.base, search.effects};
  parallel_for(fits.size(), context.threads,
               [&](std::size_t i) { fits[i] = with_form(each, found, e, plainer[i].effect); });
  std::optional<std::size_t> best;
  double least = criterion_of(search, found.explanation) + decision_of(search).undecided;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const double value = criterion_of(search, *fits[i]);
    if (!(value < least) || !all_named(search, *fits[i])) continue;
    best = i;
    least = value;
  }
  if (best) settle_for(search, e, plainer[*best], *std::move(fits[*best]), found);
}

void add(const EffectSearch& search, const RankedEffect& ranked, const Ranking& ranking,
         FoundEffects& found) {
  const Index equation = ranked.effect().candidate.equation;
  found.named.push_back(name_effect(ranked, ranking));
  found.named.back().gap_closed =
      std::clamp(drop_of(search, found.explanation, ranked.explanation, equation), 0.0, 1.0);
  found.plainer.push_back(plainer_forms(ranked, ranking, decision_of(search)));
  found.elsewhere.push_back(forms_elsewhere(ranked, ranking, decision_of(search)));
  found.explanation = ranked.explanation;
  const std::size_t count = found.named.size();
  while (take_out_one(search, found)) {
  }
  if (found.named.size() == count) return;
  for (std::size_t e = found.named.size(); e-- > 0;) compare_again(search, e, found);
}

/// An effect that is there already in another form: dry friction as sign(v) when tanh(v/w)
/// comes, or a special case of the candidate.
std::optional<std::size_t> other_form_of(const EffectSearch& search, const FoundEffects& found,
                                         const RankedEffect& ranked) {
  const std::vector<FittedEffect>& effects = found.explanation.effects;
  for (std::size_t e = 0; e < effects.size(); ++e)
    if (!are_one_form(effects[e].candidate, ranked.effect().candidate) &&
        are_forms_of_one(effects[e], found.named[e].name, ranked.effect(),
                         ranked.names.front().name, search.base.scope))
      return e;
  return std::nullopt;
}

/// Puts another form of an effect in its place, when that is better beyond doubt.
bool replace(const EffectSearch& search, std::size_t old, const RankedEffect& ranked,
             const Ranking& ranking, FoundEffects& found) {
  Explanation next = with_form(search, found, old, ranked.effect());
  const double now = criterion_of(search, found.explanation);
  if (!(criterion_of(search, next) < now - decision_of(search).undecided) ||
      !all_named(search, next))
    return false;
  take_place(search, old, name_effect(ranked, ranking), std::move(next), found);
  found.plainer[old] = plainer_forms(ranked, ranking, decision_of(search));
  found.elsewhere[old] = forms_elsewhere(ranked, ranking, decision_of(search));
  return true;
}

std::string says(const EffectSearch& search, const RankedEffect& ranked) {
  const auto k = static_cast<std::size_t>(ranked.effect().candidate.equation);
  return ranked.names.front().name + " in d" + search.problem.nominal.states()[k].name +
         "/dt: " + readable_term(ranked.effect());
}

/// One candidate of a round that falls short of nothing: whether it comes in.
Rival try_candidate(const EffectSearch& search, const RankedEffect& ranked,
                    const Ranking& ranking, FoundEffects& found) {
  Rival rival{std::string(kNamedEffects.name), says(search, ranked), ranked.criterion};
  rival.quantity = "significance";
  rival.value = ranked.sigma;
  rival.threshold = decision_of(search).significance;
  if (const auto other = other_form_of(search, found, ranked)) {
    rival.taken = replace(search, *other, ranked, ranking, found);
    if (!rival.taken) rival.rule = "another form of an effect that is there does as well";
    return rival;
  }
  add(search, ranked, ranking, found);
  rival.taken = true;
  return rival;
}

/// The best effect that may come in, or take the place of another form of itself.
/// @return whether one did.
bool add_one(const EffectSearch& search, const EffectSize& size, FoundEffects& found) {
  Ranking ranking = rank(search, found.explanation);
  const double none = criterion_of(search, found.explanation);
  Extended before{found.explanation};
  Round round{ranking.tried, "", 0.0, false};
  double best = 0.0;
  for (std::size_t i = 0; i < ranking.effects.size(); ++i) {
    const RankedEffect& ranked = ranking.effects[i];
    const std::string label = ranked.names.front().name + ": " + term_of(ranked.effect());
    if (round.best.empty()) round = {ranking.tried, label, ranked.sigma, false};
    if (round.accepted) {
      const std::string name(search.problem.options.criterion->info().name);
      Rival rival{std::string(kNamedEffects.name),
                  says(search, ranked),
                  ranked.criterion,
                  false,
                  name,
                  ranked.criterion,
                  best};
      if (ranked.criterion < best) rival.rule = "a plainer form does as well";
      found.rivals.push_back(std::move(rival));
      continue;
    }
    if (const auto why = shortfall(search, size, before, ranked)) {
      found.rivals.push_back({std::string(kNamedEffects.name), says(search, ranked),
                              ranked.criterion, false, why->quantity, why->value,
                              why->threshold});
      // What falls short is no rival of what comes in.
      ranking.effects.erase(ranking.effects.begin() + static_cast<std::ptrdiff_t>(i--));
      set_probabilities(ranking, none);
      continue;
    }
    Rival rival = try_candidate(search, ranked, ranking, found);
    if (rival.taken) {
      round = {ranking.tried, label, ranked.sigma, true};
      best = ranked.criterion;
    }
    found.rivals.push_back(std::move(rival));
  }
  found.rounds.push_back(round);
  return round.accepted;
}

/// add_one(); what a deadline ends in the middle of a round is as it was before it.
bool add_in_time(const EffectSearch& search, const EffectSize& size, FoundEffects& found) {
  FoundEffects before = found;
  try {
    return add_one(search, size, found);
  } catch (const OutOfTime&) {
    found = std::move(before);
    throw;
  }
}

/// Later effects are sought only where something is left; the first one may be of a kind that a
/// white disturbance hardly shows (a small constant, a line).
bool may_go_on(const EffectSearch& search, const FoundEffects& found) {
  const DecisionOptions& decision = decision_of(search);
  if (static_cast<int>(found.named.size()) >= decision.max_effects) return false;
  if (!search.has_room(found.explanation, 1)) return false;
  return found.named.empty() || is_left_in(found.left, decision);
}

/// Effects come in, one after another, as long as they may.
void add_all(const EffectSearch& search, const EffectSize& size, FoundEffects& found) {
  do {
    found.left = structure_left(search.problem, found.explanation.fit);
  } while (may_go_on(search, found) && add_in_time(search, size, found));
}

/// Puts a plainer form in the place of an effect where it leaves hardly more.
bool prefer(const EffectSearch& search, const EffectSize& size, std::size_t e,
            const OtherForm& plainer, FoundEffects& found) {
  const Candidate& candidate = plainer.effect.candidate;
  if (has_form(found, candidate, e)) return false;
  Explanation next = with_form(search, found, e, plainer.effect);
  if (!std::isfinite(next.fit.deviance) || !all_named(search, next) ||
      !size.is_near(next.fit, found.explanation.fit, candidate))
    return false;
  settle_for(search, e, plainer, std::move(next), found);
  found.left = structure_left(search.problem, found.explanation.fit);
  return true;
}

/// Where structure is left in the end, special forms that the likelihood prefers for it give
/// way to plain ones. @return whether any did.
bool prefer_plain(const EffectSearch& search, const EffectSize& size, FoundEffects& found) {
  bool changed = false;
  for (std::size_t e = found.named.size(); e-- > 0;) {
    if (!is_left_in(found.left, decision_of(search), found.named[e].equation)) continue;
    const std::vector<OtherForm> plainer = found.plainer[e];
    changed |= std::any_of(plainer.begin(), plainer.end(), [&](const OtherForm& form) {
      return prefer(search, size, e, form, found);
    });
  }
  return changed;
}

/// Puts the best candidate that is no more intricate in the place of an effect where that is better
/// beyond doubt. @return whether one does.
bool exchange(const EffectSearch& search, const EffectSize& size, std::size_t e,
              FoundEffects& found) {
  FoundEffects rest = without_effect(search, found, e);
  const Ranking ranking = rank(search, rest.explanation);
  Extended before{rest.explanation};
  const double least = criterion_of(search, found.explanation) - decision_of(search).undecided;
  const Index most = found.explanation.effects[e].candidate.intricacy();
  for (const RankedEffect& ranked : ranking.effects) {
    if (!(ranked.criterion < least) || ranked.effect().candidate.intricacy() > most ||
        other_form_of(search, rest, ranked) ||
        shortfall(search, size, before, ranked))
      continue;
    rest.rounds.push_back({ranking.tried,
                           ranked.names.front().name + ": " + term_of(ranked.effect()),
                           ranked.sigma, true});
    add(search, ranked, ranking, rest);
    found = std::move(rest);
    found.left = structure_left(search.problem, found.explanation.fit);
    return true;
  }
  return false;
}

/// Plain forms where they do. What came in beside a special form was chosen for what that form
/// leaves: beside a plain one each effect has to be the best in its place once more, and then
/// others may come in.
void settle_forms(const EffectSearch& search, const EffectSize& size, FoundEffects& found) {
  if (!prefer_plain(search, size, found) || found.named.size() < 2) return;
  bool exchanged = false;
  for (std::size_t e = found.named.size(); e-- > 0;)
    if (e < found.named.size()) exchanged |= exchange(search, size, e, found);
  if (!exchanged) return;
  add_all(search, size, found);
  prefer_plain(search, size, found);
}

/// Numbers may have moved since an effect was named: it gets the name that they have now.
void settle_names(const EffectSearch& search, FoundEffects& found) {
  const NameTable table = search.names();
  for (std::size_t e = 0; e < found.named.size(); ++e) {
    const FittedEffect& effect = found.explanation.effects[e];
    const std::vector<Name> names = table.names_of(effect, found.explanation.fit.model);
    NamedEffect& named = found.named[e];
    if (names.empty() || names.front().name == named.name) continue;
    take_name(effect, names.front(), named);
    std::erase_if(named.alternatives, [&](const Alternative& alternative) {
      return alternative.name == named.name;
    });
  }
}

}  // namespace

FoundEffects search_effects(const EffectSearch& search) {
  const EffectSize size(search.problem, search.base);
  FoundEffects found{{{}, search.base.fitted}};
  try {
    add_all(search, size, found);
    settle_forms(search, size, found);
    if (agree_on_forms(search, found))
      found.left = structure_left(search.problem, found.explanation.fit);
  } catch (const OutOfTime&) {
    const RunContext unhurried = search.problem.context.unhurried();
    found.left = structure_left(alone(search.problem, unhurried), found.explanation.fit);
  }
  settle_names(search, found);
  update_numbers(found.explanation, found.named);
  return found;
}

std::vector<Twin> rivals_elsewhere(const EffectSearch& search, const FoundEffects& found) {
  const double limit = criterion_of(search, found.explanation) + decision_of(search).undecided;
  std::vector<Twin> result;
  for (std::size_t e = 0; e < found.named.size(); ++e)
    for (const OtherForm& form : found.elsewhere[e]) {
      if (has_form(found, form.effect.candidate)) continue;
      const Explanation other = with_form(search, found, e, form.effect);
      if (criterion_of(search, other) > limit || !all_named(search, other)) continue;
      const OdeModel& nominal = search.problem.nominal;
      result.push_back(
          twin_of({form.named}, nominal,
                  "in the place of " + found.named[e].name + " the records allow as well " +
                      form.named.name + " (" + readable_term(form.effect) + ")" +
                      place_of(form.named, nominal) +
                      "; coefficients that are known (--tolerance) may decide"));
      result.back().instead_of = found.named[e].name;
    }
  return result;
}

}  // namespace lacuna
