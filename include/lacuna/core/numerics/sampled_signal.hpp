// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <algorithm>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// How a signal goes on between its samples: the polynomial through so many samples nearest to
/// the interval.
enum class Interpolation : Index {
  Held = 1,    ///< the last sample holds
  Linear = 2,  ///< straight lines
  Cubic = 4,   ///< the error falls as step^4
  Quintic = 6,  ///< the error falls as step^6
};

/// Whether slopes are smooth as the signal's are, but for the error.
constexpr bool is_smooth(Interpolation interpolation) {
  return interpolation >= Interpolation::Cubic;
}

/// A curve over a span of time, in Legendre polynomials of x = 2 share - 1.
struct SpanCurve {
  double mean = 0.0, slope = 0.0, bend = 0.0;  ///< mean + slope x + bend (3 x^2 - 1) / 2

  /// The value at a fraction (0..1) of the span.
  double at(double fraction) const noexcept {
    const double x = 2.0 * fraction - 1.0;
    return mean + slope * x + 0.5 * bend * (3.0 * x * x - 1.0);
  }
};

/// One sampled quantity as a function of time: in each sampling interval a polynomial, in
/// Newton's form, so that a value costs a few operations. Records with fewer samples than the
/// polynomial wants use what there is. A value; not for use from several threads at once.
class SampledSignal {
 public:
  /// @param time n >= 1, strictly increasing; @param values n; of one that is NaN or infinite,
  /// or
  ///   of differences beyond the finite numbers, the polynomials near it are NaN.
  /// @throws ArgumentError when shapes do not fit, there is no sample or the times do not
  /// increase.
  SampledSignal(Vector time, const Eigen::Ref<const Vector>& values,
                Interpolation interpolation = Interpolation::Cubic);

  /// The polynomial of the interval t_i .. t_{i+1} at t, which may be its end: what a held
  /// signal is just before it changes.
  double in_interval(Index interval, double t) const {
    const Index first = first_of(interval);
    const double* difference = differences_.data() + first * points_;
    const double* sample = time_.data() + first;
    double value = difference[points_ - 1];
    for (Index k = points_ - 2; k >= 0; --k) value = value * (t - sample[k]) + difference[k];
    return value;
  }

  /// The value at t, at a sample that of the interval which begins there; before the first
  /// sample and after the last one that sample holds. Times that go forward are found at once.
  double operator()(double t) {
    const double* begin = time_.data();
    const Index n = time_.size();
    t = std::clamp(t, begin[0], begin[n - 1]);
    if (t < begin[interval_]) interval_ = 0;
    if (interval_ + 1 < n && begin[interval_ + 1] <= t) ++interval_;
    if (interval_ + 1 < n && begin[interval_ + 1] <= t)
      interval_ = std::upper_bound(begin, begin + n, t) - begin - 1;
    return in_interval(interval_, t);
  }

  /// Third derivative over 3! in an interval, of the cubic through the four samples about it; 0
  /// of a signal that is held or goes on in straight lines.
  double third_difference(Index interval) const;

  /// Of a held signal over a span in which it may jump: the parabola of least squares, which
  /// has its mean and its first and second moments. A linear system does to fourth order in
  /// the length of the span under it what it does under the signal.
  SpanCurve held_moments(double from, double to);

  /// The same where a function that need not be linear is made of it: the line of least
  /// squares, less steep where it would leave the values of the signal.
  SpanCurve held_line(double from, double to);

  const Vector& time() const noexcept { return time_; }  ///< of the n samples

 private:
  /// The parabola of least squares, with the ends of the values that the signal has.
  struct HeldSpan {
    SpanCurve curve;
    double least, most;
  };
  HeldSpan held_span(double from, double to);

  Index first_of(Index interval) const {
    return std::clamp(interval, before_, time_.size() - points_ + before_) - before_;
  }

  Vector time_;
  Index points_, before_;
  Matrix differences_;  ///< points x n, divided: row k of samples i ... i + k
  Index interval_ = 0;  ///< of the last query
};

/// Values between samples by the cubic through the four samples nearest to each query.
/// @param time n >= 1, strictly increasing; @param values n; not finite near values that are
/// not.
/// @param queries outside of the record the first or last sample holds; NaN at NaN.
/// @throws ArgumentError as SampledSignal.
Vector interpolate_cubic(const Vector& time, const Vector& values, const Vector& queries);

/// Integral from the first sample to each sample of the same piecewise cubic, 0 at the first:
/// exact for cubics, else the error falls as step^4.
/// @param time n >= 1, strictly increasing; @param values n; not finite from one on that is
/// not.
/// @throws ArgumentError as SampledSignal.
Vector integrate_cubic(const Vector& time, const Vector& values);

}  // namespace lacuna
