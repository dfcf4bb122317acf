// SPDX-License-Identifier: MIT
#include "lacuna/numerics/local_cubic.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// The cubics through the samples around each interval of one signal, in Newton's form.
class PiecewiseCubic {
 public:
  PiecewiseCubic(const Vector& time, const Vector& values)
      : time_(time),
        points_(std::min<Index>(4, time.size())),
        differences_(Matrix::Zero(time.size(), points_)) {
    const Index n = time.size();
    differences_.col(0) = values;
    for (Index k = 1; k < points_; ++k) {
      const auto below = differences_.col(k - 1);
      differences_.col(k).head(n - k) = (below.segment(1, n - k) - below.head(n - k)).array() /
                                        (time.tail(n - k) - time.head(n - k)).array();
    }
  }

  double in_interval(Index interval, double t) const {
    const Index first = std::clamp<Index>(interval - 1, 0, time_.size() - points_);
    double value = differences_(first, points_ - 1);
    for (Index k = points_ - 2; k >= 0; --k)
      value = value * (t - time_[first + k]) + differences_(first, k);
    return value;
  }

  /// Queries that go forward are found at once.
  double operator()(double t) {
    const double* begin = time_.data();
    if (t < time_[interval_]) interval_ = 0;
    if (interval_ + 1 < time_.size() && time_[interval_ + 1] <= t) ++interval_;
    if (interval_ + 1 < time_.size() && time_[interval_ + 1] <= t)
      interval_ = std::upper_bound(begin, begin + time_.size(), t) - begin - 1;
    return in_interval(interval_, t);
  }

 private:
  const Vector& time_;
  Index points_;
  Matrix differences_;  ///< divided: column k of samples i ... i + k
  Index interval_ = 0;
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
