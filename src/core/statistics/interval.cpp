// SPDX-License-Identifier: MIT
#include "lacuna/core/statistics/interval.hpp"

#include <boost/math/distributions/students_t.hpp>

#include "lacuna/core/base/error.hpp"

namespace lacuna {

double student_quantile_975(double freedom) {
  if (!(freedom >= 1.0))
    throw ArgumentError("student_quantile_975", "fewer than one degree of freedom", "");
  return boost::math::quantile(boost::math::students_t(freedom), 0.975);
}

std::array<double, 2> interval95(double estimate, double standard_error, double quantile) {
  const double half = quantile * standard_error;
  return {estimate - half, estimate + half};
}

}  // namespace lacuna
