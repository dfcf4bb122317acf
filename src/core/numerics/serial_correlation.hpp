// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// How far the values of a series have something in common.
struct SerialCorrelation {
  double time = 1.0;  ///< tau = 1 + 2 sum rho_l^2 over the lags l = 1 .. reach, at least 1
  Index reach = 0;    ///< the lag W from which on nothing is left
};

/// Correlation of a series of residuals with itself. The sum of products of n residuals and n
/// values of a column with the same correlation has tau times the variance that it has for
/// independent ones (Bartlett 1946), so that n / tau rows count.
///
/// The sum ends at the first W >= 5 tau(W) (Sokal's self-consistent window, Functional
/// Integration (1997) 131), or at n / 4; from each rho^2 what chance leaves, 1 / n, is taken
/// off. Residuals of zeros and of numbers that are not finite have time 1.
SerialCorrelation serial_correlation(const Vector& residuals);

}  // namespace lacuna
