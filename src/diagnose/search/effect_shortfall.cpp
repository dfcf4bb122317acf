// SPDX-License-Identifier: MIT
#include "effect_shortfall.hpp"

#include <cmath>

#include "diagnose/criterion/effect_parts.hpp"

namespace lacuna {
namespace {

/// Why the numbers of an explanation with one more effect make no sense: what it adds nearly
/// cancels what the others do, or a nominal coefficient that was as it was given is not any
/// more. Where structure is left such forms, which follow it for a step or two, gain most.
std::optional<Shortfall> absurdity(const EffectSearch& search, const Explanation& before,
                                   const RankedEffect& ranked) {
  const DecisionOptions& decision = search.problem.options.decision;
  const OdeModel& nominal = search.problem.nominal;
  const double left = largest_cancellation(added_parts(ranked.explanation, nominal,
                                                       ranked.effect().candidate.equation))
                          .left;
  if (left < decision.cancelling)
    return Shortfall{"the rest of terms that cancel", left, decision.cancelling};
  const auto moved = [&](const Assimilation& fit) {
    const std::size_t free = search.base.fit_options.free.size();
    return static_cast<double>(moved_coefficients(fit, nominal, free, decision).size());
  };
  const double had = moved(before.fit), has = moved(ranked.explanation.fit);
  if (has > had) return Shortfall{"nominal coefficients out of scale", has, had};
  return std::nullopt;
}

/// Nominal coefficients that contradict what was said of them: losses (of a state in its own
/// equation, negative as they were given) that have become gains, and those that are ten of
/// their tolerances off.
double contradicted(const EffectSearch& search, const Assimilation& fit) {
  // A decision (docs/decisions.md).
  constexpr double kMostTolerances = 10.0;
  const OdeModel& nominal = search.problem.nominal;
  double count = 0.0;
  for (const MovedCoefficient& one : moved_coefficients(
           fit, nominal, search.base.fit_options.free.size(), search.problem.options.decision))
    count += one.given < 0.0 && one.changes_sign() &&
             one.term == nominal.states()[static_cast<std::size_t>(one.equation)].name;
  for (const CoefficientPrior& prior : search.problem.options.tolerances) {
    const auto k = static_cast<std::size_t>(prior.place.equation);
    const auto term = static_cast<std::size_t>(prior.place.term);
    const double fitted = fit.model.equations()[k][term].coefficient;
    count += std::abs(fitted - prior.mean) > kMostTolerances * prior.deviation;
  }
  return count;
}

/// An effect has no name where it needs what contradicts the nominal model.
std::optional<Shortfall> turned_losses(const EffectSearch& search, const Explanation& before,
                                       const RankedEffect& ranked) {
  const double had = contradicted(search, before.fit);
  const double has = contradicted(search, ranked.explanation.fit);
  if (has > had) return Shortfall{"nominal coefficients that are contradicted", has, had};
  return std::nullopt;
}

}  // namespace

double ratio_to_error(const FittedEffect& effect) {
  return effect.deviation > 0.0 ? std::abs(effect.coefficient) / effect.deviation : INFINITY;
}

std::optional<Shortfall> shortfall(const EffectSearch& search, const EffectSize& size,
                                   Extended& before, const RankedEffect& ranked) {
  const DecisionOptions& decision = search.problem.options.decision;
  if (ranked.sigma < decision.significance)
    return Shortfall{"significance", ranked.sigma, decision.significance};
  if (ranked.contribution < decision.effect_size)
    return Shortfall{"effect size", ranked.contribution, decision.effect_size};
  if (const double ratio = ratio_to_error(ranked.effect()); ratio < decision.significance)
    return Shortfall{"coefficient over its error", ratio, decision.significance};
  if (const auto turned = turned_losses(search, before.explanation, ranked)) return turned;
  if (before.explanation.effects.empty()) return std::nullopt;
  if (const auto absurd = absurdity(search, before.explanation, ranked)) return absurd;
  return size.shortfall(before, ranked.explanation);
}

}  // namespace lacuna
