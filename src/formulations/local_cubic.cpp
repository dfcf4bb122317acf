// SPDX-License-Identifier: MIT
#include "lacuna/formulations/local_cubic.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// The polynomial through the samples around one interval, in Lagrange's form.
class LocalCubic {
 public:
  /// @param interval number of the sample in front of the point wanted.
  LocalCubic(const Vector& time, const Vector& values, Index interval)
      : time_(time),
        values_(values),
        count_(std::min<Index>(4, time.size())),
        first_(std::clamp<Index>(interval - 1, 0, time.size() - count_)) {}

  double operator()(double t) const {
    double sum = 0.0;
    for (Index i = first_; i < first_ + count_; ++i) sum += weight(i, t) * values_[i];
    return sum;
  }

 private:
  double weight(Index i, double t) const {
    double product = 1.0;
    for (Index j = first_; j < first_ + count_; ++j)
      if (j != i) product *= (t - time_[j]) / (time_[i] - time_[j]);
    return product;
  }

  const Vector& time_;
  const Vector& values_;
  Index count_;
  Index first_;
};

}  // namespace

Vector interpolate_cubic(const Vector& time, const Vector& values, const Vector& queries) {
  Vector result(queries.size());
  for (Index i = 0; i < queries.size(); ++i) {
    const double* after = std::upper_bound(time.data(), time.data() + time.size(), queries[i]);
    result[i] = LocalCubic(time, values, after - time.data() - 1)(queries[i]);
  }
  return result;
}

Vector integrate_cubic(const Vector& time, const Vector& values) {
  // Two Gauss points integrate a cubic exactly.
  const double gauss = 0.5 / std::sqrt(3.0);
  Vector result = Vector::Zero(time.size());
  for (Index i = 0; i + 1 < time.size(); ++i) {
    const LocalCubic cubic(time, values, i);
    const double step = time[i + 1] - time[i];
    const double middle = time[i] + 0.5 * step;
    const double sum = cubic(middle - gauss * step) + cubic(middle + gauss * step);
    result[i + 1] = result[i] + 0.5 * step * sum;
  }
  return result;
}

}  // namespace lacuna
