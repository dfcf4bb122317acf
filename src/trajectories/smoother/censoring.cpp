// SPDX-License-Identifier: MIT
#include "censoring.hpp"

#include <cmath>

namespace lacuna {
namespace {

/// Facts: below it erfc loses its digits and two terms of the tail's series have 1e-8; log
/// sqrt(2 pi).
constexpr double kFarBelow = -25.0, kLogRootTwoPi = 0.91893853320467274178;

/// log Phi(z); far below 0 by the asymptotic series of the tail.
double log_probability(double z) {
  if (z > kFarBelow) return std::log(0.5 * std::erfc(-z * M_SQRT1_2));
  const double s = 1.0 / (z * z);
  return -0.5 * z * z - std::log(-z) - kLogRootTwoPi + std::log1p(-s + 3.0 * s * s);
}

}  // namespace

Truncation::Truncation(double z) {
  const double log_phi = log_probability(z);
  deviance = -2.0 * log_phi;
  shift = std::exp(-0.5 * z * z - kLogRootTwoPi - log_phi);
  // lambda + z cancels far below 0, where it is 1/|z| (1 - 2/z^2 ...)
  const double sum = z > kFarBelow ? shift + z : -1.0 / z * (1.0 - 2.0 / (z * z));
  fraction = shift * sum;
}

}  // namespace lacuna
