// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

std::string to_string(ValidationVerdict verdict) {
  switch (verdict) {
    case ValidationVerdict::FitsToNoise:
      return "fits to noise";
    case ValidationVerdict::Approximation:
      return "approximation";
    case ValidationVerdict::WrongLibrary:
      return "wrong library";
    case ValidationVerdict::Incomplete:
      return "incomplete";
    case ValidationVerdict::Undecided:
      break;
  }
  return "cannot tell";
}

double PredictionError::fraction() const {
  const double noise_squared = noise_estimated ? noise * noise : 0.0;
  const double beyond = std::max(0.0, error * error - noise_squared);
  const double moved = std::max(motion * motion - noise_squared, noise_squared);
  return beyond > 0.0 ? std::sqrt(beyond / std::max(moved, 1e-300)) : 0.0;
}

}  // namespace lacuna
