// SPDX-License-Identifier: MIT
#include "decision/substance.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/diagnosis/gauge.hpp"
#include "lacuna/estimation/disturbance_test.hpp"
#include "decision/window_refit.hpp"

namespace lacuna {
namespace {

/// Variance of the disturbance of the equation that an effect acts on, or of all where it is
/// one of the measurement.
double variance(const Assimilation& fit, const Candidate& newest, const Vector& rates) {
  return newest.place == Place::Channel ? total_disturbance(fit, rates)
                                        : std::pow(fit.noise.disturbance[newest.equation], 2);
}

}  // namespace

Substance::Substance(const Assimilation& base, const Dataset& data,
                     const AssimilationOptions& options, const RunContext& context)
    : base_(base),
      data_(data),
      options_(options),
      context_(context),
      rates_(rate_rms(base)),
      base_gap_(window_gap(base)) {}

double Substance::disturbance(const Assimilation& fit, const Candidate& newest) const {
  const double whole = variance(base_, newest, rates_);
  return whole > 0.0 ? variance(fit, newest, rates_) / whole : 0.0;
}

double Substance::gap(const Assimilation& fit) const {
  return std::pow(window_gap(fit) / base_gap_, 2);
}

double Substance::least_gap(const Explanation& explanation) const {
  const double own = gap(explanation.fit);
  const auto refitted = refit_over_windows(data_, options_, explanation, context_);
  return refitted ? std::min(own, gap(refitted->fit)) : own;
}

bool Substance::counts(const Explanation& before, const Explanation& after) const {
  constexpr double kTenth = 0.1;
  const Candidate& newest = after.effects.back().candidate;
  const double had = disturbance(before.fit, newest), has = disturbance(after.fit, newest);
  if (has > (1.0 - kTenth) * had) return false;
  if (has < 0.5 * had) return true;
  if (had - has < kTwentieth) return false;
  const double lasting = least_gap(before);
  return lasting >= kTwentieth && lasting - least_gap(after) >= kTwentieth;
}

bool Substance::is_near(const Assimilation& fit, const Assimilation& best,
                        const Candidate& newest) const {
  return disturbance(fit, newest) - disturbance(best, newest) <= kTwentieth &&
         gap(fit) - gap(best) <= kTwentieth;
}

}  // namespace lacuna
