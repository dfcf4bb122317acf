// SPDX-License-Identifier: MIT
#include "model_comparison.hpp"

#include <algorithm>
#include <cmath>

#include "unseen_noise.hpp"

namespace lacuna {
namespace {

/// A model that does not stay finite has a misfit that says nothing of its size.
bool is_judged(const EquationFit& fit) { return fit.misfit && std::isfinite(*fit.misfit); }

bool is_known_to_fit(const EquationFit& fit) {
  return fit.identity || fit.fits_to_noise.value_or(false);
}

}  // namespace

bool reaches_the_noise(const IdentificationResult& result) {
  return std::all_of(result.fit.begin(), result.fit.end(),
                     [](const EquationFit& fit) { return fit.fits_to_noise.value_or(true); });
}

bool is_known_to_fit(const IdentificationResult& result) {
  return std::all_of(result.fit.begin(), result.fit.end(),
                     [](const EquationFit& fit) { return is_known_to_fit(fit); });
}

ModelComparison::ModelComparison(const Dataset& data, const std::vector<StateNoise>& noise) {
  const Vector unseen = unseen_noise(data);
  for (Index k = 0; k < data.state_count(); ++k) {
    const StateNoise& state = noise[static_cast<std::size_t>(k)];
    seen_.push_back(!data.is_measured(k) ||
                    (state.kind != NoiseKind::None && state.sigma > unseen[k]));
  }
}

double ModelComparison::excess(const IdentificationResult& of,
                               const IdentificationResult& over) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < of.fit.size(); ++k) sum += excess_in(k, of, over);
  return sum;
}

bool ModelComparison::is_ahead(const IdentificationResult& one,
                               const IdentificationResult& other, double same) const {
  if (!is_known_to_fit(one) || is_known_to_fit(other)) return false;
  double sum = 0.0;
  for (std::size_t k = 0; k < one.fit.size(); ++k) {
    if (seen_[k] && !is_known_to_fit(other.fit[k])) return true;
    if (!seen_[k]) sum += excess_in(k, one, other);
  }
  return sum < -same;
}

double ModelComparison::excess_in(std::size_t equation, const IdentificationResult& of,
                                  const IdentificationResult& over) const {
  const EquationFit &one = of.fit[equation], &other = over.fit[equation];
  if (one.identity) return 0.0;
  const bool both = seen_[equation] && is_judged(one) && is_judged(other);
  return std::log(std::max(both ? *one.misfit : one.residual_rms, 1e-300) /
                  std::max(both ? *other.misfit : other.residual_rms, 1e-300));
}

}  // namespace lacuna
