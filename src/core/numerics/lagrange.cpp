// SPDX-License-Identifier: MIT
#include "core/numerics/lagrange.hpp"

#include <algorithm>

#include "core/base/check.hpp"

namespace lacuna {
namespace {

void check_samples(const Vector& time, const Matrix& values, Index points) {
  if (time.size() != values.rows())
    throw ArgumentError("interpolation", "times and values differ in number", "");
  if (points < 1 || time.size() < points)
    throw ArgumentError("interpolation",
                        std::to_string(time.size()) + " samples are too few for a polynomial " +
                            "through " + std::to_string(points),
                        "use a method of lower order or a longer record");
  check_times(time, 1, "interpolation");
}

}  // namespace

LagrangeWindow LagrangeWindow::centred(Index points) { return {points, (points - 1) / 2}; }

LagrangeWindow LagrangeWindow::driving(int order) {
  const Index points = std::max(order, 2);
  return {points, std::min<Index>(points / 2, points - 2)};
}

LagrangeInterpolant::LagrangeInterpolant(const Vector& time, const Matrix& values,
                                         LagrangeWindow window)
    : time_(time),
      values_(values),
      window_(window),
      weights_(static_cast<std::size_t>(std::max<Index>(window.points, 0))),
      factors_(weights_.size()) {
  check_samples(time, values, window.points);
  select(0);
}

void LagrangeInterpolant::select(Index interval) {
  const Index last = time_.size() - 1;
  const Index first = std::clamp<Index>(
      std::clamp<Index>(interval, 0, last) - std::clamp<Index>(window_.before, -last, last), 0,
      time_.size() - window_.points);
  if (first == first_) return;
  first_ = first;
  prepare();
}

Index LagrangeInterpolant::interval_of(double t) const {
  const double* begin = time_.data();
  const Index after = std::upper_bound(begin, begin + time_.size(), t) - begin;
  return std::max<Index>(after - 1, 0);
}

// Weights relative to the length of the window, so that no power of a small step underflows.
void LagrangeInterpolant::prepare() {
  const double* node = time_.data() + first_;
  const std::size_t count = weights_.size();
  const double scale = count > 1 ? 1.0 / (node[count - 1] - node[0]) : 1.0;
  for (std::size_t i = 0; i < count; ++i) {
    double product = 1.0;
    for (std::size_t j = 0; j < count; ++j)
      if (j != i) product *= (node[i] - node[j]) * scale;
    weights_[i] = 1.0 / product;
  }
}

void LagrangeInterpolant::evaluate(double t, double* out) {
  const double* node = time_.data() + first_;
  double sum = 0.0;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    if (t == node[i] || weights_.size() == 1) {
      Eigen::Map<Eigen::RowVectorXd>(out, values_.cols()) =
          values_.row(first_ + static_cast<Index>(i));
      return;
    }
    factors_[i] = weights_[i] / (t - node[i]);
    sum += factors_[i];
  }
  for (Index q = 0; q < values_.cols(); ++q) {
    const double* column = values_.data() + q * values_.rows() + first_;
    double value = 0.0;
    for (std::size_t i = 0; i < factors_.size(); ++i) value += factors_[i] * column[i];
    out[q] = value / sum;
  }
}

}  // namespace lacuna
