// SPDX-License-Identifier: MIT
#include "data/derivatives/golden_section.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"

namespace lacuna {

double least_on_grid(const std::function<double(double)>& f, double low, double high,
                     double spacing) {
  check_argument(high > low && spacing > 0.0, "least_on_grid", "the range is empty");
  double best = low, least = f(low);
  for (double x = low + spacing; x < high + 0.5 * spacing; x += spacing)
    if (const double value = f(x); value < least) {
      least = value;
      best = x;
    }
  constexpr double kGolden = 0.6180339887498949;
  double a = std::max(low, best - spacing), b = std::min(high, best + spacing);
  double c = b - kGolden * (b - a), d = a + kGolden * (b - a);
  double fc = f(c), fd = f(d);
  while (b - a > 0.05 * spacing) {
    if (fc < fd) {
      b = d, d = c, fd = fc, c = b - kGolden * (b - a), fc = f(c);
    } else {
      a = c, c = d, fc = fd, d = a + kGolden * (b - a), fd = f(d);
    }
  }
  const double middle = fc < fd ? c : d;
  return std::min(fc, fd) < least ? middle : best;
}

}  // namespace lacuna
