// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <map>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// A number with the variance of its estimate.
struct Estimate {
  double value = 0.0;
  double variance = 0.0;
};

/// A polynomial in v variables whose coefficients are estimates, independent of one another.
class Polynomial {
 public:
  using Exponents = std::vector<int>;  ///< v entries

  /// Adds to a coefficient; variances add up.
  void add(const Exponents& exponents, Estimate coefficient);

  const std::map<Exponents, Estimate>& terms() const noexcept { return terms_; }

 private:
  std::map<Exponents, Estimate> terms_;
};

Polynomial sum(const Polynomial& a, const Polynomial& b);

/// The polynomial times a number that is known exactly.
Polynomial scaled(const Polynomial& p, double factor);

/// A product with a polynomial whose coefficients are known exactly: variances grow by their
/// squares.
Polynomial product(const Polynomial& p, const Polynomial& exact);

/// dp/dx of one variable.
/// @throws ArgumentError when there is no such variable; the same below.
Polynomial derivative(const Polynomial& p, Index variable);

/// p with a polynomial, known exactly, in place of a variable.
Polynomial substituted(const Polynomial& p, Index variable, const Polynomial& exact);

/// p at a value of one variable; the variable stays, with exponent 0.
Polynomial evaluated(const Polynomial& p, Index variable, double value);

}  // namespace lacuna
