// SPDX-License-Identifier: MIT
#include "shared_form.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace lacuna {
namespace {

bool is_instant(const Candidate& candidate) {
  return candidate.place == Place::Rate && candidate.memory.empty();
}

/// A form in another equation; one fraction may have the other sign, so the bounds hold for
/// both.
Candidate in_equation(Candidate candidate, Index equation) {
  candidate.equation = equation;
  const double most = std::max(candidate.most, -candidate.least);
  candidate.least = -most;
  candidate.most = most;
  return candidate;
}

/// Whether two effects are different functions of one argument in two equations.
bool differ_in_form(const FittedEffect& a, const FittedEffect& b) {
  const Candidate &one = a.candidate, &other = b.candidate;
  return is_instant(one) && is_instant(other) && one.equation != other.equation &&
         one.argument == other.argument && one.within == other.within &&
         !are_one_form(one, in_equation(other, one.equation));
}

/// Both effects as the form of `model`.
struct Agreement {
  Explanation explanation;
  std::vector<Name> of_model, of_follower;
  double criterion = 0.0;
};

std::optional<Agreement> agreement(const EffectSearch& search, const FoundEffects& found,
                                   std::size_t model, std::size_t follower) {
  std::vector<FittedEffect> effects = found.explanation.effects;
  const Index equation = effects[follower].candidate.equation;
  effects[follower].candidate = in_equation(effects[model].candidate, equation);
  effects[follower].shapes = effects[model].shapes;
  Agreement result{
      explain_on(search.problem, search.base, found.explanation.fit, effects), {}, {}, 0.0};
  const NameTable table = search.names();
  const auto names = [&](std::size_t e) {
    return table.names_of(result.explanation.effects[e], result.explanation.fit.model);
  };
  result.of_model = names(model);
  result.of_follower = names(follower);
  const double significance = search.problem.options.decision.significance;
  const FittedEffect& fitted = result.explanation.effects[follower];
  if (result.of_model.empty() || result.of_follower.empty() ||
      std::abs(fitted.coefficient) < significance * fitted.deviation)
    return std::nullopt;
  result.criterion = criterion_of(search.problem, search.base, result.explanation);
  return result;
}

/// The better of the two forms for two effects, where it does as well as both.
bool agree(const EffectSearch& search, std::size_t a, std::size_t b, FoundEffects& found) {
  std::optional<Agreement> best;
  double least = criterion_of(search.problem, search.base, found.explanation) +
                 search.problem.options.decision.undecided;
  for (const auto& [model, follower] : {std::pair{a, b}, std::pair{b, a}}) {
    std::optional<Agreement> next = agreement(search, found, model, follower);
    if (!next || !(next->criterion < least)) continue;
    least = next->criterion;
    if (model == b) std::swap(next->of_model, next->of_follower);
    best = std::move(next);
  }
  if (!best) return false;
  found.explanation = std::move(best->explanation);
  for (const auto& [e, names] : {std::pair{a, &best->of_model}, {b, &best->of_follower}}) {
    const FittedEffect& effect = found.explanation.effects[e];
    take_name(effect, names->front(), found.named[e]);
    found.rounds.push_back(
        {2, names->front().name + ": " + term_of(effect), found.named[e].sigma, true});
  }
  return true;
}

}  // namespace

bool agree_on_forms(const EffectSearch& search, FoundEffects& found) {
  bool is_changed = false;
  const std::vector<FittedEffect>& effects = found.explanation.effects;
  for (std::size_t a = 0; a < effects.size(); ++a)
    for (std::size_t b = a + 1; b < effects.size(); ++b)
      if (differ_in_form(effects[a], effects[b]))
        is_changed = agree(search, a, b, found) || is_changed;
  return is_changed;
}

}  // namespace lacuna
