// SPDX-License-Identifier: MIT
#include "lacuna/numerics/local_cubic.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/numerics/lagrange.hpp"

namespace lacuna {
namespace {

/// The cubics through the samples around each interval of one signal.
class PiecewiseCubic {
 public:
  PiecewiseCubic(const Vector& time, const Vector& values)
      : values_(values),
        interpolant_(time, values_, LagrangeWindow::centred(std::min<Index>(4, time.size()))) {}

  double in_interval(Index interval, double t) {
    double value = 0.0;
    interpolant_.select(interval);
    interpolant_.evaluate(t, &value);
    return value;
  }

  double operator()(double t) { return in_interval(interpolant_.interval_of(t), t); }

 private:
  Matrix values_;
  LagrangeInterpolant interpolant_;
};

}  // namespace

Vector interpolate_cubic(const Vector& time, const Vector& values, const Vector& queries) {
  PiecewiseCubic cubic(time, values);
  Vector result(queries.size());
  for (Index i = 0; i < queries.size(); ++i) result[i] = cubic(queries[i]);
  return result;
}

Vector integrate_cubic(const Vector& time, const Vector& values) {
  // Two Gauss points integrate a cubic exactly.
  const double gauss = 0.5 / std::sqrt(3.0);
  PiecewiseCubic cubic(time, values);
  Vector result = Vector::Zero(time.size());
  for (Index i = 0; i + 1 < time.size(); ++i) {
    const double step = time[i + 1] - time[i];
    const double middle = time[i] + 0.5 * step;
    const double sum = cubic.in_interval(i, middle - gauss * step) +
                       cubic.in_interval(i, middle + gauss * step);
    result[i + 1] = result[i] + 0.5 * step * sum;
  }
  return result;
}

}  // namespace lacuna
