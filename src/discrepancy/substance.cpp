// SPDX-License-Identifier: MIT
#include "substance.hpp"

#include <cmath>

#include "lacuna/discrepancy/gauge.hpp"
#include "lacuna/discrepancy/structure.hpp"

namespace lacuna {
namespace {

/// Variance of the disturbance of the equation that an effect acts on, or of all where it is
/// one of the measurement.
double variance(const Assimilation& fit, const Candidate& newest, const Vector& rates) {
  return newest.place == Place::Channel ? total_disturbance(fit, rates)
                                        : std::pow(fit.noise.disturbance[newest.equation], 2);
}

}  // namespace

Substance::Substance(const Assimilation& base)
    : base_(base), rates_(rate_rms(base)), base_gap_(window_gap(base)) {}

double Substance::disturbance(const Assimilation& fit, const Candidate& newest) const {
  const double whole = variance(base_, newest, rates_);
  return whole > 0.0 ? variance(fit, newest, rates_) / whole : 0.0;
}

double Substance::gap(const Assimilation& fit) const {
  return std::pow(window_gap(fit) / base_gap_, 2);
}

bool Substance::counts(const Assimilation& before, const Assimilation& after,
                       const Candidate& newest) const {
  constexpr double kTenth = 0.1;
  const double had = disturbance(before, newest), has = disturbance(after, newest);
  if (has > (1.0 - kTenth) * had) return false;
  if (has < 0.5 * had) return true;
  return had - has >= kTwentieth && gap(before) - gap(after) >= kTwentieth;
}

bool Substance::is_near(const Assimilation& fit, const Assimilation& best,
                        const Candidate& newest) const {
  return disturbance(fit, newest) - disturbance(best, newest) <= kTwentieth &&
         gap(fit) - gap(best) <= kTwentieth;
}

}  // namespace lacuna
