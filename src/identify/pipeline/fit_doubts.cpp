// SPDX-License-Identifier: MIT
#include "fit_doubts.hpp"

#include "core/base/text.hpp"

namespace lacuna {
namespace {

/// Holds the residual against what measurement noise alone makes of the target.
void compare_with_noise(EquationFit& fit, std::vector<std::string>& warnings) {
  const double noise = fit.noise_floor.value_or(0.0);
  if (noise <= 0.0) return;
  fit.fits_to_noise = fit.residual_rms <= kFitsBelow * noise;
  if (*fit.fits_to_noise) return;
  fit.doubt = "d" + fit.equation + "/dt: the residual (rms " +
              format_number(fit.residual_rms, 3) + ") is " +
              format_number(fit.residual_rms / noise, 2) +
              " times what measurement noise explains";
  warnings.push_back(fit.doubt);
}

}  // namespace

void judge_fits(IdentificationResult& result) {
  // A decision on a warning (docs/decisions.md).
  constexpr double kPoorFit = 0.1;
  for (EquationFit& fit : result.fit) {
    if (fit.identity) continue;
    compare_with_noise(fit, result.warnings);
    if (!fit.fits_to_noise && fit.residual_rms > kPoorFit * fit.target_rms)
      result.warnings.push_back(left_hand_side(fit.equation, result.model.evolution()) +
                                ": the terms leave " +
                                format_number(100.0 * fit.residual_rms / fit.target_rms, 2) +
                                (result.model.is_map() ? " % of the next sample unexplained"
                                                       : " % of the derivative unexplained"));
  }
}

}  // namespace lacuna
