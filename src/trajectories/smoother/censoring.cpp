// SPDX-License-Identifier: MIT
#include "censoring.hpp"

#include <algorithm>
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

double density(double z) { return std::exp(-0.5 * z * z - kLogRootTwoPi); }

/// Mean (beyond `low`), variance and log of the probability of the tail between `low`, far from
/// 0, and `low` + width, where the density falls as exp(-low z).
struct FarInterval {
  double beyond, variance, log_probability;

  FarInterval(double low, double width) {
    const double rest = std::exp(-low * width), inside = -std::expm1(-low * width);
    beyond = 1.0 / low - width * rest / inside;
    variance = 1.0 / (low * low) - width * width * rest / (inside * inside);
    log_probability = -0.5 * low * low - kLogRootTwoPi + std::log(inside / low);
  }
};

}  // namespace

Truncation::Truncation(double low, double high) {
  const double side = low + high < 0.0 ? -1.0 : 1.0;  // the upper tail has no rounding
  const double near = side > 0.0 ? low : -high, far = side > 0.0 ? high : -low;
  if (near > -kFarBelow) {
    const FarInterval tail(near, far - near);
    deviance = -2.0 * tail.log_probability;
    shift = side * (near + tail.beyond);
    fraction = 1.0 - tail.variance;
    return;
  }
  const double inside = 0.5 * (std::erfc(near * M_SQRT1_2) - std::erfc(far * M_SQRT1_2));
  const double probability = std::max(inside, 1e-300);
  const double at_near = density(near), at_far = density(far);
  const double mean = (at_near - at_far) / probability;
  deviance = -2.0 * std::log(probability);
  shift = side * mean;
  fraction = std::clamp(mean * mean + (far * at_far - near * at_near) / probability, 0.0, 1.0);
}

Truncation::Truncation(double z) {
  const double log_phi = log_probability(z);
  deviance = -2.0 * log_phi;
  shift = std::exp(-0.5 * z * z - kLogRootTwoPi - log_phi);
  // lambda + z cancels far below 0, where it is 1/|z| (1 - 2/z^2 ...)
  const double sum = z > kFarBelow ? shift + z : -1.0 / z * (1.0 - 2.0 / (z * z));
  fraction = shift * sum;
}

}  // namespace lacuna
