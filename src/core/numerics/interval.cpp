// SPDX-License-Identifier: MIT
#include "core/numerics/interval.hpp"

#include <cmath>

#include "lacuna/core/base/error.hpp"

namespace lacuna {

double student_quantile_975(double freedom) {
  if (!(freedom >= 1.0))
    throw ArgumentError("student_quantile_975", "fewer than one degree of freedom", "");
  if (freedom < 2.0) return 12.706204736432095;
  if (freedom < 3.0) return 4.302652729911275;
  constexpr double z = 1.959963984540054;
  const double z2 = z * z;
  const double g1 = z * (z2 + 1.0) / 4.0;
  const double g2 = z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
  const double g3 = z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
  const double g4 =
      z * ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0;
  const double v = 1.0 / freedom;
  return z + v * (g1 + v * (g2 + v * (g3 + v * g4)));
}

}  // namespace lacuna
