// SPDX-License-Identifier: MIT
#include "lacuna/core/statistics/interval.hpp"

#include <boost/math/distributions/students_t.hpp>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

double student_quantile(double freedom, double probability, const char* caller) {
  if (!(freedom >= 1.0)) throw ArgumentError(caller, "fewer than one degree of freedom", "");
  return boost::math::quantile(boost::math::students_t(freedom), probability);
}

}  // namespace

double student_quantile_975(double freedom) {
  return student_quantile(freedom, 0.975, "student_quantile_975");
}

double student_quantile_95(double freedom) {
  return student_quantile(freedom, 0.95, "student_quantile_95");
}

std::array<double, 2> interval95(double estimate, double standard_error, double quantile) {
  const double half = quantile * standard_error;
  return {estimate - half, estimate + half};
}

}  // namespace lacuna
