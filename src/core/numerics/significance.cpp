// SPDX-License-Identifier: MIT
#include "core/numerics/significance.hpp"

#include <math.h>

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// log of the gamma function for a > 0. std::lgamma writes the sign to a global variable, which
/// threads would share.
double log_gamma(double a) {
  int sign = 0;
  return ::lgamma_r(a, &sign);
}

/// log of the regularised upper incomplete gamma function by its continued fraction (Lentz);
/// converges for x > a + 1. Source: Abramowitz and Stegun 6.5.31.
double log_gamma_tail_fraction(double a, double x) {
  constexpr double kTiny = 1e-300;
  double b = x + 1.0 - a;
  double c = 1.0 / kTiny;
  double d = 1.0 / b;
  double h = d;
  for (int i = 1; i < 500; ++i) {
    const double factor = -i * (i - a);
    b += 2.0;
    d = 1.0 / std::max(std::abs(factor * d + b), kTiny);
    c = std::max(std::abs(b + factor / c), kTiny);
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-14) break;
  }
  return -x + a * std::log(x) - log_gamma(a) + std::log(h);
}

/// The lower function by its series (6.5.29), for small x.
double gamma_lower_series(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (int i = 1; i < 500 && term > 1e-17 * sum; ++i) sum += term *= x / (a + i);
  return sum * std::exp(-x + a * std::log(x) - log_gamma(a));
}

/// log of the two-sided normal tail beyond sigma.
double log_normal_tail(double sigma) { return log_chi_squared_tail(sigma * sigma, 1.0); }

}  // namespace

double log_chi_squared_tail(double value, double freedom) {
  if (value <= 0.0) return 0.0;
  const double a = 0.5 * freedom;
  const double x = 0.5 * value;
  if (x > a + 1.0) return log_gamma_tail_fraction(a, x);
  return std::log1p(-std::min(gamma_lower_series(a, x), 1.0));
}

double sigma_of_log_probability(double log_probability) {
  if (!(log_probability < 0.0)) return 0.0;
  double low = 0.0;
  double high = std::sqrt(-2.0 * log_probability) + 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (log_normal_tail(middle) > log_probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double sigma_of_gain(double gain, double freedom, double tried) {
  return sigma_of_log_probability(log_chi_squared_tail(gain, freedom) +
                                  std::log(std::max(tried, 1.0)));
}

}  // namespace lacuna
