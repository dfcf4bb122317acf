// SPDX-License-Identifier: MIT
// What a sample shows that is known to be at least, or at most, so large.
#pragma once

namespace lacuna {

/// A normal variable of which only z > 0 is known, z = mean / deviation.
///
/// With the standard normal density phi and distribution Phi: the probability is Phi(z), the
/// mean moves by lambda deviations and the variance shrinks by the fraction delta,
///   lambda = phi(z) / Phi(z), delta = lambda (lambda + z),
/// the moments of the truncated normal distribution (Tobin, Econometrica 26 (1958); Johnson,
/// Kotz and Balakrishnan, Continuous Univariate Distributions 1 (1994), Ch. 13.10).
struct Truncation {
  double deviance = 0.0;  ///< -2 log Phi(z)
  double shift = 0.0;     ///< lambda
  double fraction = 0.0;  ///< delta, 0 .. 1

  explicit Truncation(double z);

  /// Of which low < z < high is known, z in deviations from the mean: with P = Phi(high) -
  /// Phi(low) the mean moves by lambda = (phi(low) - phi(high)) / P deviations and the variance
  /// shrinks by the fraction delta = lambda^2 + (high phi(high) - low phi(low)) / P (the same,
  /// Ch. 13.10.1): a value on a lattice, of which the rounding is known and no noise. `low` is
  /// less than `high`.
  Truncation(double low, double high);
};

}  // namespace lacuna
