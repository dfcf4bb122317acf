// SPDX-License-Identifier: MIT
#include "lacuna/hypotheses/rank.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "lacuna/core/parallel.hpp"
#include "lacuna/estimation/disturbance_test.hpp"
#include "lacuna/numerics/significance.hpp"

namespace lacuna {
namespace {

bool same_place(const Candidate& a, const Candidate& b) {
  return a.equation == b.equation && a.place == b.place && a.argument == b.argument;
}

/// Whether an effect that is there covers a candidate: another one of its kind with other
/// numbers, or what it is a special case of.
bool covers(const Candidate& adopted, const Candidate& candidate) {
  if (!same_place(adopted, candidate)) return false;
  if (adopted.plainer == candidate.effect) return true;
  if (adopted.effect != candidate.effect || candidate.repeats) return false;
  const bool same_form =
      adopted.form == candidate.form || (!adopted.memory.empty() && !candidate.memory.empty());
  return same_form || candidate.shapes.size() < adopted.shapes.size();
}

/// Whether a candidate is for the search: not a free input, not in an equation that holds
/// exactly, not covered by what is there.
bool is_searched(const Candidate& candidate, const Explanation& current) {
  const bool exact = current.fit.noise.disturbance[candidate.equation] == 0.0;
  if (candidate.is_driven() || (candidate.place == Place::Rate && exact)) return false;
  return std::none_of(
      current.effects.begin(), current.effects.end(),
      [&](const FittedEffect& adopted) { return covers(adopted.candidate, candidate); });
}

std::vector<Candidate> all_candidates(const std::vector<Stage<Effect>>& effects,
                                      const Scope& scope, const Explanation& current) {
  std::vector<Candidate> result;
  const std::vector<std::string> taken = current.fit.model.variables().names();
  for (const Stage<Effect>& effect : effects)
    for (Index k = 0; k < scope.model.dimension(); ++k)
      for (Candidate& candidate : effect->candidates(scope, k))
        if (is_searched(candidate, current))
          result.push_back(without_clash(std::move(candidate), taken));
  return result;
}

/// The two best of each effect and equation, with and without shapes, in the order of the
/// screening: those that may be significant and that are not far behind the best, whose lead
/// only grows by an exact fit. The second is of another argument: a lag of a product whose
/// factor seems to lag as well.
std::vector<ScreenedCandidate> short_list(const std::vector<ScreenedCandidate>& screened,
                                          Index count) {
  constexpr double kPossible = 2.0;  // standard deviations
  constexpr double kFarBehind = 0.05;
  constexpr std::size_t kOfEach = 2;
  std::vector<ScreenedCandidate> result;
  const auto tried = static_cast<double>(screened.size());
  const double best = screened.empty() ? 0.0 : screened.front().gain;
  std::map<std::tuple<std::string, Index, bool>, std::set<std::string>> seen;
  for (const ScreenedCandidate& candidate : screened) {
    if (static_cast<Index>(result.size()) == count) break;
    const double freedom = 1.0 + static_cast<double>(candidate.shapes.size());
    if (candidate.gain < kFarBehind * best ||
        sigma_of_gain(candidate.gain, freedom, tried) < kPossible)
      continue;
    const bool shaped = candidate.shapes.size() > 0;
    std::set<std::string>& arguments =
        seen[{candidate.candidate.effect, candidate.candidate.equation, shaped}];
    if (arguments.size() < kOfEach && arguments.insert(candidate.candidate.argument).second)
      result.push_back(candidate);
  }
  return result;
}

/// rms of coefficient x form over that of the rate of the state it acts on.
double contribution_of(const FittedEffect& effect, const Assimilation& fit) {
  const Candidate candidate = without_clash(effect.candidate, fit.model.variables().names());
  double sum = 0.0;
  Index count = 0;
  for (const LinearisedRecord& record : fit.records) {
    const Vector values = form_along(
        candidate, {effect.shapes.data(), static_cast<std::size_t>(effect.shapes.size())},
        fit.model.variables(), record);
    const double mean = candidate.form == "1" ? 0.0 : values.mean();
    sum += (values.array() - mean).square().sum();
    count += values.size();
  }
  const double rms = std::abs(effect.coefficient) * std::sqrt(sum / static_cast<double>(count));
  if (candidate.place == Place::Channel) {
    const auto& path = fit.records.front().path.col(candidate.equation);
    return rms / std::sqrt((path.array() - path.mean()).square().mean());
  }
  return rms / rate_rms(fit)[candidate.equation];
}

double bic_of(const Explanation& explanation) {
  return explanation.fit.deviance + static_cast<double>(explanation.parameters()) *
                                        std::log(static_cast<double>(explanation.fit.used));
}

class Ranker {
 public:
  Ranker(const Dataset& data, const OdeModel& nominal, const Explanation& current,
         const AssimilationOptions& options, const RunContext& context)
      : data_(data),
        nominal_(nominal),
        current_(current),
        options_(options),
        context_(context) {}

  RankedEffect rough(const FittedEffect& next, double tried) const {
    std::vector<FittedEffect> effects = current_.effects;
    effects.push_back(next);
    return judged(explain_roughly(data_, nominal_, current_.fit, effects, options_, context_),
                  tried);
  }

  RankedEffect exact(const RankedEffect& ranked, double tried) const {
    return judged(explain(data_, nominal_, ranked.explanation.fit, ranked.explanation.effects,
                          options_, context_),
                  tried);
  }

 private:
  RankedEffect judged(Explanation explanation, double tried) const {
    RankedEffect ranked{std::move(explanation)};
    ranked.criterion = bic_of(ranked.explanation);
    ranked.gain = current_.fit.deviance - ranked.explanation.fit.deviance;
    ranked.sigma = sigma_of_gain(
        ranked.gain, 1.0 + static_cast<double>(ranked.effect().shapes.size()), tried);
    ranked.contribution = contribution_of(ranked.effect(), ranked.explanation.fit);
    return ranked;
  }

  const Dataset& data_;
  const OdeModel& nominal_;
  const Explanation& current_;
  const AssimilationOptions& options_;
  const RunContext& context_;
};

bool is_one_shape(const ShapeParameter& a, const ShapeParameter& b) {
  return a.name == b.name && a.low == b.low && a.high == b.high;
}

bool is_one_memory(const MemoryState& a, const MemoryState& b) {
  return a.name == b.name && a.rate == b.rate && a.start == b.start && a.driven == b.driven;
}

/// Whether two effects are one but for what they are called, so that one fit does for both.
bool are_namesakes(const FittedEffect& a, const FittedEffect& b) {
  const Candidate& one = a.candidate;
  const Candidate& other = b.candidate;
  return one.place == other.place && one.equation == other.equation && one.form == other.form &&
         a.shapes == b.shapes &&
         std::equal(one.shapes.begin(), one.shapes.end(), other.shapes.begin(),
                    other.shapes.end(), is_one_shape) &&
         std::equal(one.memory.begin(), one.memory.end(), other.memory.begin(),
                    other.memory.end(), is_one_memory);
}

/// The place of each effect's first namesake, its own for most.
std::vector<std::size_t> first_namesakes(const std::vector<FittedEffect>& effects) {
  std::vector<std::size_t> first(effects.size());
  for (std::size_t i = 0; i < effects.size(); ++i)
    while (!are_namesakes(effects[first[i]], effects[i])) ++first[i];
  return first;
}

/// fit(0) ... fit(count - 1), in this order; namesakes share a fit.
template <class Fit>
std::vector<RankedEffect> fitted_in_parallel(const std::vector<FittedEffect>& effects,
                                             int threads, Fit fit) {
  const std::vector<std::size_t> first = first_namesakes(effects);
  std::vector<std::optional<RankedEffect>> places(effects.size());
  parallel_for(effects.size(), threads, [&](std::size_t i) {
    if (first[i] == i) places[i] = fit(i);
  });
  std::vector<RankedEffect> result;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    result.push_back(first[i] == i ? std::move(*places[i]) : result[first[i]]);
    result.back().explanation.effects.back().candidate = effects[i].candidate;
  }
  return result;
}

/// Whether the disturbance of the effect's equation is less with it. A form that follows the
/// path's own rate (a delay or a lag of the state itself, shorter than a step) can take the
/// place of the rate; then the likelihood rises and the disturbance does not fall. So it is
/// with a channel that is corrected by the rate of a noisy path: an effect there has to take
/// away most of what disturbs the equations together, so that it is judged on a smooth path.
bool lessens_disturbance(const RankedEffect& ranked, const Explanation& current,
                         const Vector& rates) {
  constexpr double kMost = 0.5;
  const Candidate& candidate = ranked.effect().candidate;
  if (candidate.place == Place::Channel)
    return total_disturbance(ranked.explanation.fit, rates) <
           (1.0 - kMost) * total_disturbance(current.fit, rates);
  const double before = current.fit.noise.disturbance[candidate.equation];
  return ranked.explanation.fit.noise.disturbance[candidate.equation] < before;
}

/// Whether the effects that were there before still have numbers such as they can have, by
/// whatever name. One that is not told from 0 any more, or that the new one stands for, will
/// go.
bool leaves_others_plausible(const RankedEffect& ranked,
                             const std::vector<Stage<Effect>>& effects, const Scope& scope) {
  constexpr double kTold = 3.0;  // standard deviations
  const std::vector<FittedEffect>& all = ranked.explanation.effects;
  const OdeModel& model = ranked.explanation.fit.model;
  return std::all_of(all.begin(), all.end() - 1, [&](const FittedEffect& old) {
    const bool goes = std::abs(old.coefficient) < kTold * old.deviation ||
                      mean_the_same(old, ranked.effect()) ||
                      ranked.effect().candidate.plainer == old.candidate.effect;
    return goes || is_plausible(old, model, effects, scope) ||
           other_name_of(old, model, effects, scope);
  });
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

/// Weights exp(-BIC/2) against the best; a second name of the same term weighs nothing.
std::vector<double> weights_of(const std::vector<RankedEffect>& effects, double least) {
  std::vector<double> weights;
  for (auto effect = effects.begin(); effect != effects.end(); ++effect) {
    const bool again = std::any_of(effects.begin(), effect, [&](const RankedEffect& other) {
      return have_one_term(other.effect(), effect->effect());
    });
    weights.push_back(again ? 0.0 : std::exp(-0.5 * (effect->criterion - least)));
  }
  return weights;
}

void set_probabilities(Ranking& ranking, double none_criterion) {
  double least = none_criterion;
  for (const RankedEffect& effect : ranking.effects) least = std::min(least, effect.criterion);
  const std::vector<double> weights = weights_of(ranking.effects, least);
  ranking.none = std::exp(-0.5 * (none_criterion - least));
  const double sum = std::accumulate(weights.begin(), weights.end(), ranking.none);
  ranking.none /= sum;
  for (RankedEffect& effect : ranking.effects) {
    effect.probability = 0.0;
    for (std::size_t j = 0; j < weights.size(); ++j)
      if (mean_the_same(effect.effect(), ranking.effects[j].effect()))
        effect.probability += weights[j] / sum;
  }
}

/// Shape parameters and memory states: what makes a candidate less plain.
Index intricacy(const RankedEffect& ranked) {
  const Candidate& candidate = ranked.effect().candidate;
  return static_cast<Index>(candidate.shapes.size() + 2 * candidate.memory.size());
}

/// Of those in the same equation that the data cannot tell from the best, the least intricate
/// goes first.
void put_least_intricate_first(std::vector<RankedEffect>& effects) {
  if (effects.empty()) return;
  const double limit = effects.front().criterion + kUndecided;
  const Index equation = effects.front().effect().candidate.equation;
  auto place = effects.begin();
  for (auto other = effects.begin(); other != effects.end(); ++other)
    if (other->criterion <= limit && other->effect().candidate.equation == equation &&
        intricacy(*other) < intricacy(*place))
      place = other;
  std::rotate(effects.begin(), place, place + 1);
}

/// The plainer of two names goes first where the data cannot tell them apart.
void put_plainer_first(std::vector<RankedEffect>& effects) {
  if (effects.empty() || !effects.front().effect().candidate.plainer) return;
  const double limit = effects.front().criterion + kUndecided;
  const auto place =
      std::find_if(effects.begin() + 1, effects.end(), [&](const RankedEffect& other) {
        return other.effect().candidate.effect == *effects.front().effect().candidate.plainer &&
               other.criterion <= limit &&
               other.effect().candidate.equation == effects.front().effect().candidate.equation;
      });
  if (place != effects.end()) std::rotate(effects.begin(), place, place + 1);
}

}  // namespace

bool have_one_term(const FittedEffect& a, const FittedEffect& b) {
  const auto term = [](const FittedEffect& effect) {
    return bind_form(effect.candidate,
                     {effect.shapes.data(), static_cast<std::size_t>(effect.shapes.size())})
        .to_string();
  };
  const bool plain = a.candidate.memory.empty() && b.candidate.memory.empty();
  return plain && a.candidate.place == b.candidate.place &&
         a.candidate.equation == b.candidate.equation && term(a) == term(b);
}

bool is_plausible(const FittedEffect& fitted, const OdeModel& model,
                  const std::vector<Stage<Effect>>& effects, const Scope& scope) {
  for (const Stage<Effect>& effect : effects)
    if (effect->info().name == fitted.candidate.effect)
      return effect->plausible(scope, fitted.candidate,
                               {model, fitted.coefficient, fitted.deviation, fitted.shapes});
  return true;
}

std::optional<Candidate> other_name_of(const FittedEffect& fitted, const OdeModel& model,
                                       const std::vector<Stage<Effect>>& effects,
                                       const Scope& scope) {
  std::optional<Candidate> best;
  for (const Stage<Effect>& family : effects)
    for (Candidate& other : family->candidates(scope, fitted.candidate.equation)) {
      if (other.shapes.size() != fitted.candidate.shapes.size()) continue;
      FittedEffect renamed = fitted;
      renamed.candidate = other;
      const bool fits =
          have_one_term(renamed, fitted) && is_plausible(renamed, model, effects, scope);
      if (fits && (!best || best->plainer == other.effect)) best = std::move(other);
    }
  return best;
}

bool mean_the_same(const FittedEffect& a, const FittedEffect& b) {
  const bool same_name = a.candidate.effect == b.candidate.effect;
  return (same_name && same_place(a.candidate, b.candidate)) || have_one_term(a, b);
}

Ranking rank(const Dataset& data, const Explanation& current,
             const std::vector<Stage<Effect>>& effects, const Scope& scope,
             const AssimilationOptions& options, const RankOptions& rank_options,
             const RunContext& context) {
  const Screening screening(current.fit);
  const std::vector<ScreenedCandidate> screened =
      screen(all_candidates(effects, scope, current), screening, context);
  Ranking ranking;
  for (const ScreenedCandidate& candidate : screened) ranking.tried += candidate.tried;
  const RunContext quiet{context.stop, {}, 1, context.seed};
  const Ranker ranker(data, scope.model, current, options, quiet);
  const auto tried = static_cast<double>(screened.size());
  const Vector rates = rate_rms(current.fit).head(scope.model.dimension());
  const auto is_sound = [&](const RankedEffect& ranked) {
    return std::isfinite(ranked.criterion) && lessens_disturbance(ranked, current, rates);
  };
  const auto plausible = [&](const RankedEffect& ranked) {
    return is_plausible(ranked.effect(), ranked.explanation.fit.model, effects, scope) &&
           leaves_others_plausible(ranked, effects, scope);
  };
  std::vector<FittedEffect> chosen;
  for (const ScreenedCandidate& next : short_list(screened, rank_options.refits))
    chosen.push_back({next.candidate, next.shapes, next.coefficient, 0.0});
  context.report("fitting candidates", 0.0);
  ranking.effects = fitted_in_parallel(
      chosen, context.threads, [&](std::size_t i) { return ranker.rough(chosen[i], tried); });
  // Numbers at shapes that are not settled say nothing against a name.
  std::erase_if(ranking.effects, [&](const auto& ranked) {
    return !is_sound(ranked) || (ranked.effect().shapes.size() == 0 && !plausible(ranked));
  });
  sort_by_criterion(ranking.effects);
  const std::size_t leaders = keep_leaders(ranking.effects, plausible);
  const std::size_t exact =
      std::min(ranking.effects.size(), leaders + static_cast<std::size_t>(rank_options.exact));
  context.report("fitting candidates exactly", 0.0);
  chosen.clear();
  for (std::size_t i = 0; i < exact; ++i) chosen.push_back(ranking.effects[i].effect());
  std::vector<RankedEffect> fitted = fitted_in_parallel(
      chosen, context.threads,
      [&](std::size_t i) { return ranker.exact(ranking.effects[i], tried); });
  std::move(fitted.begin(), fitted.end(), ranking.effects.begin());
  std::erase_if(ranking.effects,
                [&](const auto& ranked) { return !is_sound(ranked) || !plausible(ranked); });
  sort_by_criterion(ranking.effects);
  set_probabilities(ranking, bic_of(current));
  put_least_intricate_first(ranking.effects);
  put_plainer_first(ranking.effects);
  return ranking;
}

}  // namespace lacuna
