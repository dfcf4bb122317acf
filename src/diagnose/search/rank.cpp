// SPDX-License-Identifier: MIT
#include "diagnose/search/rank.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "core/base/parallel.hpp"
#include "core/statistics/significance.hpp"
#include "diagnose/criterion/effect_parts.hpp"
#include "disturbed_alone.hpp"
#include "forms/candidate/nesting.hpp"
#include "lacuna/trajectories/smoother/disturbance_test.hpp"
#include "short_list.hpp"

namespace lacuna {
namespace {

/// Whether a constant in the place of an effect takes the mean of what it adds: one beside it
/// in the equation, or an offset of the channel, which no state follows.
bool has_constant(const Candidate& candidate, const Assimilation& fit) {
  if (candidate.form.variables().empty()) return false;
  if (candidate.place == Place::Channel) return true;
  const Equation& terms = fit.model.equations()[static_cast<std::size_t>(candidate.equation)];
  return std::any_of(terms.begin(), terms.end(), [](const WeightedTerm& summand) {
    return summand.term.expression().variables().empty();
  });
}

/// rms of coefficient x form over that of the rate of the state it acts on, about the mean
/// where a constant takes that: dry friction of what turns one way only is constant, and acts.
double contribution_of(const FittedEffect& effect, const Assimilation& fit) {
  const Candidate& candidate = effect.candidate;
  double sum = 0.0, square = 0.0;
  Index count = 0;
  for (const LinearisedRecord& record : fit.records) {
    const Vector values = effect_along(effect, fit, record);
    sum += values.sum();
    square += values.squaredNorm();
    count += values.size();
  }
  const auto samples = static_cast<double>(count);
  const double mean = has_constant(candidate, fit) ? sum / samples : 0.0;
  const double rms = std::sqrt(std::max(0.0, square / samples - mean * mean));
  if (candidate.place == Place::Channel) {
    const auto& path = fit.records.front().path.col(candidate.equation);
    return rms / std::sqrt((path.array() - path.mean()).square().mean());
  }
  return rms / rate_rms(fit)[candidate.equation];
}

/// What a fit with one more effect is worth. @param tried number of candidates.
RankedEffect judged(const EffectSearch& search, const Explanation& current,
                    Explanation explanation, double tried) {
  RankedEffect ranked{std::move(explanation)};
  const FittedEffect& effect = ranked.effect();
  ranked.criterion = criterion_of(search.problem, search.base, ranked.explanation);
  ranked.gain = current.fit.deviance - ranked.explanation.fit.deviance;
  ranked.sigma =
      sigma_of_gain(ranked.gain, 1.0 + static_cast<double>(effect.shapes.size()), tried);
  ranked.contribution = contribution_of(effect, ranked.explanation.fit);
  ranked.names = search.names().names_of(effect, ranked.explanation.fit.model);
  return ranked;
}

/// fit(0) ... fit(count - 1), in this order.
template <class Fit>
std::vector<RankedEffect> fitted_in_parallel(std::size_t count, int threads, Fit fit) {
  std::vector<std::optional<RankedEffect>> places(count);
  parallel_for(count, threads, [&](std::size_t i) { places[i] = fit(i); });
  std::vector<RankedEffect> result;
  for (std::optional<RankedEffect>& place : places) result.push_back(std::move(*place));
  return result;
}

/// Whether the disturbance of the effect's equation is less with it. A form that follows the
/// path's own rate (a delay or a lag of the state itself, shorter than a step) can take the
/// place of the rate; then the likelihood rises and the disturbance does not fall. So it is
/// with a channel that is corrected by the rate of a noisy path: an effect there has to take
/// away most of what disturbs the equations together, so that it is judged on a smooth path.
/// Where states are hidden the disturbance of one equation stands for what another one lacks:
/// they have to fall together.
bool lessens_disturbance(const RankedEffect& ranked, const Explanation& current,
                         const Vector& rates, double most) {
  const Candidate& candidate = ranked.effect().candidate;
  const bool on_channel = candidate.place == Place::Channel;
  const bool hidden = current.fit.held.rows() > 0;
  if (on_channel || hidden)
    return total_disturbance(ranked.explanation.fit, rates) <
           (on_channel ? 1.0 - most : 1.0) * total_disturbance(current.fit, rates);
  const double before = current.fit.noise.disturbance[candidate.equation];
  return ranked.explanation.fit.noise.disturbance[candidate.equation] < before;
}

std::string leading_name(const std::vector<Name>& names) {
  return names.empty() ? std::string() : names.front().name;
}

/// Leading names of the effects that are there, with the numbers that they have.
std::vector<std::string> present_names(const Explanation& current, const NameTable& table) {
  std::vector<std::string> names;
  for (const FittedEffect& effect : current.effects)
    names.push_back(leading_name(table.names_of(effect, current.fit.model)));
  return names;
}

/// Whether the effects that were there before still have numbers such as they can have, by
/// whatever name. One that is not distinguished from 0 any more, or that the new one stands
/// for, will go.
bool leaves_others_plausible(const RankedEffect& ranked, const EffectSearch& search,
                             const std::vector<std::string>& names) {
  const NameTable table = search.names();
  const double significance = search.problem.options.decision.significance;
  const std::vector<FittedEffect>& all = ranked.explanation.effects;
  for (std::size_t e = 0; e + 1 < all.size(); ++e) {
    const bool goes = std::abs(all[e].coefficient) < significance * all[e].deviation;
    if (!goes && table.names_of(all[e], ranked.explanation.fit.model).empty() &&
        !are_forms_of_one(all[e], names[e], ranked.effect(), leading_name(ranked.names),
                          table.scope))
      return false;
  }
  return true;
}

void sort_by_criterion(std::vector<RankedEffect>& effects) {
  std::stable_sort(effects.begin(), effects.end(),
                   [](const auto& a, const auto& b) { return a.criterion < b.criterion; });
}

/// Keeps of the implausible ones only those that lead before any other: their numbers may
/// become plausible in an exact fit. @return how many these are.
template <class Plausible>
std::size_t keep_leaders(std::vector<RankedEffect>& sorted, Plausible plausible) {
  const auto first = std::find_if(sorted.begin(), sorted.end(), plausible);
  const auto leaders = static_cast<std::size_t>(first - sorted.begin());
  sorted.erase(std::remove_if(first, sorted.end(), std::not_fn(plausible)), sorted.end());
  return leaders;
}

/// Whether two ranked effects are forms that have one leading name.
bool mean_the_same(const RankedEffect& a, const RankedEffect& b) {
  return in_one_place(a.effect().candidate, b.effect().candidate) &&
         leading_name(a.names) == leading_name(b.names);
}

/// Whether a form is the state of its own equation as it was before. A store beside that state does
/// the same and holds one number, where a delay remembers a whole stretch of the past.
bool remembers_own_past(const Candidate& candidate, const EffectSearch& search) {
  if (candidate.place != Place::Rate || !contains(candidate.form, Operation::Delay)) return false;
  const auto& states = search.base.scope.model.states();
  return candidate.argument.to_string() ==
         states[static_cast<std::size_t>(candidate.equation)].name;
}

/// What makes an effect less plain: terms that nearly cancel, then shapes and memory.
std::pair<bool, Index> intricacy_of(const RankedEffect& ranked, const EffectSearch& search) {
  // A fact: more than the numbers of a store between the state and another variable.
  constexpr Index kOfAStretch = 4;
  const Candidate& candidate = ranked.effect().candidate;
  const Index past = remembers_own_past(candidate, search) ? kOfAStretch : 0;
  const AddedParts parts =
      added_parts(ranked.explanation, search.problem.nominal, candidate.equation);
  return {largest_cancellation(parts).left < search.problem.options.decision.cancelling,
          candidate.intricacy() + past};
}

/// Whether the records do not distinguish an explanation from the best one: by
/// DecisionOptions::undecided, or because what the two add to the equation along the record is
/// apart by less than the size of an effect.
bool does_as_well(const RankedEffect& ranked, const RankedEffect& best,
                  const EffectSearch& search) {
  const DecisionOptions& decision = search.problem.options.decision;
  if (ranked.criterion <= best.criterion + decision.undecided) return true;
  return apart(ranked.explanation, best.explanation, search.problem.nominal,
               best.effect().candidate.equation) < decision.effect_size;
}

/// Of those in the same equation that do as well as the best, the least intricate goes first.
void put_least_intricate_first(std::vector<RankedEffect>& effects, const EffectSearch& search) {
  if (effects.empty()) return;
  const Index equation = effects.front().effect().candidate.equation;
  auto place = effects.begin();
  auto least = intricacy_of(effects.front(), search);
  for (auto other = effects.begin() + 1; other != effects.end(); ++other) {
    if (other->effect().candidate.equation != equation) continue;
    const auto intricacy = intricacy_of(*other, search);
    if (!(intricacy < least) || !does_as_well(*other, effects.front(), search)) continue;
    place = other;
    least = intricacy;
  }
  std::rotate(effects.begin(), place, place + 1);
}

/// The short list fitted in few passes, and how many of it are fitted exactly.
struct RoughRanking {
  std::vector<RankedEffect> effects;  ///< best first
  std::size_t exact = 0;
};

/// What an effect has to be to be ranked.
class Requirements {
 public:
  Requirements(const EffectSearch& search, const Explanation& current)
      : search_(search),
        current_(current),
        names_(present_names(current, search.names())),
        rates_(rate_rms(current.fit).head(search.base.scope.model.dimension())) {}

  /// Whether the fit is one and the disturbance falls.
  bool sound(const RankedEffect& ranked) const {
    return std::isfinite(ranked.criterion) &&
           lessens_disturbance(ranked, current_, rates_,
                               search_.problem.options.decision.major);
  }

  /// Whether it has a name, and those that were there before keep theirs.
  bool plausible(const RankedEffect& ranked) const {
    return !ranked.names.empty() && leaves_others_plausible(ranked, search_, names_);
  }

 private:
  const EffectSearch& search_;
  const Explanation& current_;
  std::vector<std::string> names_;
  Vector rates_;
};

RoughRanking rank_roughly(const EffectSearch& search, const Explanation& current,
                          const Requirements& required, const ShortList& shortened) {
  const RunContext& context = search.problem.context;
  const DecisionOptions& decision = search.problem.options.decision;
  const auto tried = static_cast<double>(shortened.screened);
  const std::vector<Listed>& list = shortened.candidates;
  context.report("fitting candidates", 0.0);
  const RunContext quiet = context.beside_others();
  const Problem problem = alone(search.problem, quiet);
  RoughRanking rough{fitted_in_parallel(list.size(), context.threads, [&](std::size_t i) {
    const ScreenedCandidate& one = list[i].screened;
    std::vector<FittedEffect> effects = current.effects;
    effects.push_back({one.candidate, one.shapes, one.coefficient, 0.0});
    const Assimilation start =
        list[i].start ? loosened(*list[i].start, search.base) : current.fit;
    return judged(search, current, explain_roughly_on(problem, search.base, start, effects),
                  tried);
  })};
  // Numbers at shapes that are not settled say nothing against a name.
  std::erase_if(rough.effects, [&](const RankedEffect& ranked) {
    return !required.sound(ranked) ||
           (ranked.effect().shapes.size() == 0 && !required.plausible(ranked));
  });
  sort_by_criterion(rough.effects);
  const std::size_t leaders = keep_leaders(
      rough.effects, [&](const RankedEffect& ranked) { return required.plausible(ranked); });
  rough.exact =
      std::min(rough.effects.size(), leaders + static_cast<std::size_t>(decision.exact_fits));
  return rough;
}

/// Whether a candidate is an input that the equation has by its value, and that acts late.
bool is_late_input(const Candidate& candidate, const EffectSearch& search) {
  const Expression& x = candidate.argument;
  if (x.operation() != Operation::Variable || candidate.shapes.size() != 1 ||
      !candidate.memory.empty() || candidate.within ||
      !contains(candidate.form, Operation::Delay))
    return false;
  return search.base.scope.range_of(x).is_input &&
         search.problem.nominal.coefficient(candidate.equation, x.name()) != 0.0;
}

/// An input that acts late, from the nominal coefficients and from between the first whole
/// steps: without the delay coefficients go far to make up for it, and from there no fit comes
/// back.
std::optional<Explanation> late_from_nominal(const EffectSearch& search,
                                             const Candidate& candidate) {
  constexpr double kFirstSteps = 4.5;  // a fact of the search: later ones are known without
  const Scope& scope = search.base.scope;
  const double whole =
      search.problem.nominal.coefficient(candidate.equation, candidate.argument.name());
  std::optional<Explanation> best;
  for (const Vector& start : candidate.starts) {
    if (!(start[0] <= kFirstSteps * scope.step)) continue;
    Explanation next = explain_on(search.problem, search.base, search.base.given,
                                  {{candidate, start, whole, 0.0}});
    if (std::isfinite(next.fit.deviance) &&
        (!best || next.fit.deviance < best->fit.deviance))
      best = std::move(next);
  }
  return best;
}

/// The short list's inputs that act late, fitted so, where nothing is named yet.
void add_late_inputs(const EffectSearch& search, const Explanation& current,
                     const ShortList& list, std::vector<RankedEffect>& effects) {
  if (!current.effects.empty() || !search.base.fit_options.hidden.empty()) return;
  std::vector<const Candidate*> late;
  for (const Listed& one : list.candidates)
    if (is_late_input(one.screened.candidate, search)) late.push_back(&one.screened.candidate);
  const RunContext& context = search.problem.context;
  const RunContext quiet{context.stop, {}, 1, context.seed};
  const Problem problem = alone(search.problem, quiet);
  const EffectSearch each{problem, search.base, search.effects};
  std::vector<std::optional<Explanation>> fits(late.size());
  parallel_for(late.size(), context.threads,
               [&](std::size_t i) { fits[i] = late_from_nominal(each, *late[i]); });
  for (std::optional<Explanation>& fit : fits)
    if (fit)
      effects.push_back(
          judged(search, current, *std::move(fit), static_cast<double>(list.screened)));
}

/// Fits other forms of the same effect as the best exactly: at their starts, where they were
/// screened, a soft limit may be nearer to a hard one that lies far away than that itself.
/// Beside other effects, where less is left, more forms would mean more that fit it by chance.
void add_siblings(const EffectSearch& search, const Explanation& current, const ShortList& list,
                  std::vector<RankedEffect>& effects) {
  if (effects.empty() || !current.effects.empty()) return;
  std::vector<const ScreenedCandidate*> siblings;
  for (const ScreenedCandidate& one : list.siblings)
    if (are_siblings(one.candidate, effects.front().effect().candidate))
      siblings.push_back(&one);
  const RunContext& context = search.problem.context;
  const RunContext quiet = context.beside_others();
  const Problem problem = alone(search.problem, quiet);
  std::vector<RankedEffect> fitted =
      fitted_in_parallel(siblings.size(), context.threads, [&](std::size_t i) {
        std::vector<FittedEffect> with = current.effects;
        with.push_back(
            {siblings[i]->candidate, siblings[i]->shapes, siblings[i]->coefficient, 0.0});
        return judged(search, current, explain_on(problem, search.base, current.fit, with),
                      static_cast<double>(list.screened));
      });
  std::move(fitted.begin(), fitted.end(), std::back_inserter(effects));
}

/// Fits the best of a rough ranking exactly.
std::vector<RankedEffect> rank_exactly(const EffectSearch& search, const Explanation& current,
                                       const Requirements& required, RoughRanking rough,
                                       const ShortList& list) {
  const auto tried = static_cast<double>(list.screened);
  const RunContext& context = search.problem.context;
  context.report("fitting candidates exactly", 0.0);
  const RunContext quiet = context.beside_others();
  const Problem problem = alone(search.problem, quiet);
  std::vector<RankedEffect> fitted =
      fitted_in_parallel(rough.exact, context.threads, [&](std::size_t i) {
        return judged(search, current,
                      explain_further_on(problem, search.base, rough.effects[i].explanation),
                      tried);
      });
  std::move(fitted.begin(), fitted.end(), rough.effects.begin());
  add_late_inputs(search, current, list, rough.effects);
  const auto settle = [&] {
    std::erase_if(rough.effects, [&](const RankedEffect& ranked) {
      return !required.sound(ranked) || !required.plausible(ranked);
    });
    sort_by_criterion(rough.effects);
  };
  settle();
  add_siblings(search, current, list, rough.effects);
  settle();
  return std::move(rough.effects);
}

}  // namespace

void set_probabilities(Ranking& ranking, double none_criterion) {
  double least = none_criterion;
  for (const RankedEffect& effect : ranking.effects) least = std::min(least, effect.criterion);
  const auto weight = [&](double criterion) { return std::exp(-0.5 * (criterion - least)); };
  double sum = weight(none_criterion);
  for (const RankedEffect& effect : ranking.effects) sum += weight(effect.criterion);
  ranking.none = weight(none_criterion) / sum;
  for (RankedEffect& effect : ranking.effects) {
    effect.probability = 0.0;
    for (const RankedEffect& other : ranking.effects)
      if (mean_the_same(effect, other)) effect.probability += weight(other.criterion) / sum;
  }
}

bool are_forms_of_one(const FittedEffect& a, const std::string& name_of_a,
                      const FittedEffect& b, const std::string& name_of_b, const Scope& scope) {
  if (!in_one_place(a.candidate, b.candidate)) return false;
  return name_of_a == name_of_b || nests(a.candidate, b.candidate, b.shapes, scope) ||
         nests(b.candidate, a.candidate, a.shapes, scope);
}

Ranking rank(const EffectSearch& search, const Explanation& current) {
  const ShortList list = short_list(search, current);
  const Requirements required(search, current);
  Ranking ranking;
  ranking.tried = list.tried;
  ranking.effects =
      rank_exactly(search, current, required, rank_roughly(search, current, required, list),
                   list);
  set_probabilities(ranking, criterion_of(search.problem, search.base, current));
  put_least_intricate_first(ranking.effects, search);
  return ranking;
}

}  // namespace lacuna
