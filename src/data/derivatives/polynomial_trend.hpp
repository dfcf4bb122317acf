// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// The polynomials that fit columns best over a whole record. Smoothers whose penalty is 0 for
/// them work on what they leave, which keeps rounding small and polynomials exact.
class PolynomialTrend {
 public:
  /// @param time n > degree, strictly increasing; @param values n x m.
  /// @throws ArgumentError when shapes do not fit.
  PolynomialTrend(const Vector& time, const Matrix& values, int degree);

  /// k-th derivatives at given times, one row for each; k = 0 gives the polynomials.
  Matrix derivative(const Vector& time, int order) const;

 private:
  double centre_, scale_;
  Matrix coefficients_;  ///< degree + 1 x m, of powers of (t - centre) / scale
};

}  // namespace lacuna
