// SPDX-License-Identifier: MIT
#pragma once

namespace lacuna {

/// A standard normal number z of which it is known that it lies between two limits.
struct TruncatedNormal {
  double log_probability = 0.0;  ///< log of the probability of lying there without knowing
  double mean = 0.0;             ///< E z
  /// E (z - mean)^k of k = 2, 3 and 4.
  double variance = 1.0, third = 0.0, fourth = 3.0;
};

/// The distribution between `low` < `high`, either may be infinite, by quadrature about the most
/// probable value: differences of closed forms lose all digits where both limits are far out
/// (Johnson, Kotz and Balakrishnan, Continuous Univariate Distributions 1 (1994), Sect. 13.10).
/// Relative errors are below 1e-7.
TruncatedNormal truncated_normal(double low, double high);

}  // namespace lacuna
