// SPDX-License-Identifier: MIT
#include "effect_size.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/trajectories/smoother/disturbance_test.hpp"
#include "trajectories/windows/window_gap.hpp"
#include "window_refit.hpp"

namespace lacuna {
namespace {

/// Variance of the disturbance of the equation that an effect acts on, or of all where it is
/// one of the measurement.
double variance(const Assimilation& fit, const Candidate& newest, const Vector& rates) {
  return newest.place == Place::Channel ? total_disturbance(fit, rates)
                                        : std::pow(fit.noise.disturbance[newest.equation], 2);
}

}  // namespace

EffectSize::EffectSize(const Problem& problem, const Baseline& base)
    : problem_(problem),
      base_(base),
      rates_(rate_rms(base.fitted)),
      base_gap_(window_gap(base.fitted)) {}

double EffectSize::disturbance(const Assimilation& fit, const Candidate& newest) const {
  const double whole = variance(base_.fitted, newest, rates_);
  return whole > 0.0 ? variance(fit, newest, rates_) / whole : 0.0;
}

double EffectSize::gap(const Assimilation& fit) const {
  return std::pow(window_gap(fit) / base_gap_, 2);
}

double EffectSize::least_gap(const Explanation& explanation) const {
  const double own = gap(explanation.fit);
  const auto refitted = refit_over_windows(problem_, base_, explanation);
  return refitted ? std::min(own, gap(refitted->fit)) : own;
}

std::optional<Shortfall> EffectSize::shortfall(Extended& before,
                                               const Explanation& after) const {
  const DecisionOptions& decision = problem_.options.decision;
  const Candidate& newest = after.effects.back().candidate;
  const double had = disturbance(before.explanation.fit, newest);
  const double has = disturbance(after.fit, newest);
  if (has > (1.0 - decision.minor) * had)
    return Shortfall{"fraction of the residual that goes", 1.0 - has / had, decision.minor};
  if (has < (1.0 - decision.major) * had) return std::nullopt;
  if (had - has < decision.negligible)
    return Shortfall{"fraction of the nominal model's disturbance that goes", had - has,
                     decision.negligible};
  if (!before.least_gap) before.least_gap = least_gap(before.explanation);
  if (*before.least_gap < decision.negligible)
    return Shortfall{"fraction of the nominal model's squared gap that is left",
                     *before.least_gap, decision.negligible};
  const double goes = *before.least_gap - least_gap(after);
  if (goes >= decision.negligible) return std::nullopt;
  return Shortfall{"fraction of the nominal model's squared gap that goes", goes,
                   decision.negligible};
}

bool EffectSize::is_near(const Assimilation& fit, const Assimilation& best,
                         const Candidate& newest) const {
  const double negligible = problem_.options.decision.negligible;
  return disturbance(fit, newest) - disturbance(best, newest) <= negligible &&
         gap(fit) - gap(best) <= negligible;
}

}  // namespace lacuna
