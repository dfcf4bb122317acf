// SPDX-License-Identifier: MIT
#include "lacuna/core/numerics/sampled_signal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/check.hpp"

namespace lacuna {
namespace {

/// Checked before a member is made of them.
Vector checked_times(Vector time, Index values) {
  check_argument(time.size() == values, "SampledSignal", "times and values differ in number",
                 "give one value for each time");
  check_times(time, 1, "SampledSignal");
  return time;
}

}  // namespace

SampledSignal::SampledSignal(Vector time, const Eigen::Ref<const Vector>& values,
                             Interpolation interpolation)
    : time_(checked_times(std::move(time), values.size())),
      points_(std::min(static_cast<Index>(interpolation), time_.size())),
      before_((static_cast<Index>(interpolation) - 1) / 2),
      differences_(points_, time_.size()) {
  const Index n = time_.size();
  Vector order = values;
  differences_.row(0) = order.transpose();
  for (Index k = 1; k < points_; ++k) {
    double* out = differences_.data() + k;
    for (Index i = 0; i < n - k; ++i) {
      order[i] = (order[i + 1] - order[i]) / (time_[i + k] - time_[i]);
      out[i * points_] = order[i];
    }
    differences_.row(k).tail(k).setZero();
  }
}

double SampledSignal::third_difference(Index interval) const {
  constexpr Index kPoints = 4;  // a fact: of a cubic
  if (points_ < kPoints) return 0.0;
  return differences_(kPoints - 1, std::clamp<Index>(interval - 1, 0, time_.size() - kPoints));
}

SampledSignal::HeldSpan SampledSignal::held_span(double from, double to) {
  const Index n = time_.size();
  if (from < time_[interval_]) interval_ = 0;
  while (interval_ + 1 < n && time_[interval_ + 1] <= from) ++interval_;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  HeldSpan span{{}, kInfinity, -kInfinity};
  double a = -1.0;
  for (Index i = interval_; a < 1.0; ++i) {
    const bool last = i + 1 >= n || time_[i + 1] >= to;
    const double b = last ? 1.0 : 2.0 * (time_[i + 1] - from) / (to - from) - 1.0;
    const double value = differences_(0, i);
    span.curve.mean += 0.5 * value * (b - a);
    span.curve.slope += 0.75 * value * (b * b - a * a);
    span.curve.bend += 1.25 * value * ((b * b * b - b) - (a * a * a - a));
    span.least = std::min(span.least, value);
    span.most = std::max(span.most, value);
    a = b;
  }
  return span;
}

SpanCurve SampledSignal::held_moments(double from, double to) {
  return held_span(from, to).curve;
}

SpanCurve SampledSignal::held_line(double from, double to) {
  const auto [curve, least, most] = held_span(from, to);
  const double steepest = std::max(0.0, std::min(curve.mean - least, most - curve.mean));
  return {curve.mean, std::clamp(curve.slope, -steepest, steepest), 0.0};
}

Vector interpolate_cubic(const Vector& time, const Vector& values, const Vector& queries) {
  SampledSignal cubic(time, values);
  Vector result(queries.size());
  for (Index i = 0; i < queries.size(); ++i) result[i] = cubic(queries[i]);
  return result;
}

Vector integrate_cubic(const Vector& time, const Vector& values) {
  // Two Gauss points integrate a cubic exactly.
  const double gauss = 0.5 / std::sqrt(3.0);
  const SampledSignal cubic(time, values);
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
