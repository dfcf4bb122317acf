// SPDX-License-Identifier: MIT
#include "substance.hpp"

#include <cmath>

#include "lacuna/discrepancy/gauge.hpp"
#include "lacuna/discrepancy/structure.hpp"

namespace lacuna {
namespace {

/// Variance of the disturbance of one equation, or of all relative to their rates.
double variance(const Assimilation& fit, std::optional<Index> equation, const Vector& rates) {
  if (equation) return std::pow(fit.noise.disturbance[*equation], 2);
  double sum = 0.0;
  for (Index k = 0; k < rates.size(); ++k)
    if (rates[k] > 0.0) sum += std::pow(fit.noise.disturbance[k] / rates[k], 2);
  return sum;
}

}  // namespace

Substance::Substance(const Assimilation& base)
    : base_(base), rates_(rate_rms(base)), base_gap_(window_gap(base)) {}

double Substance::disturbance(const Assimilation& fit, const Candidate& newest) const {
  const auto equation =
      newest.place == Place::Rate ? std::optional(newest.equation) : std::nullopt;
  const double whole = variance(base_, equation, rates_);
  return whole > 0.0 ? variance(fit, equation, rates_) / whole : 0.0;
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
