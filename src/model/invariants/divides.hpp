// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace lacuna {

/// Whether a monomial divides another one: no exponent is larger. Exponents of the same
/// variables in the same order.
inline bool divides(const std::vector<int>& divisor, const std::vector<int>& exponents) {
  for (std::size_t k = 0; k < divisor.size(); ++k)
    if (divisor[k] > exponents[k]) return false;
  return true;
}

}  // namespace lacuna
