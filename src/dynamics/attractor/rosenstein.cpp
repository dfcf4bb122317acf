// SPDX-License-Identifier: MIT
#include "dynamics/attractor/rosenstein.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "data/records/check_record.hpp"

namespace lacuna {
namespace {

/// Longest time neighbours are followed, in mean periods.
constexpr Index kHorizon = 15;

/// States as columns of a m x n matrix, in units of their standard deviations.
Matrix standardised(const Matrix& states) {
  Matrix scaled = (states.rowwise() - states.colwise().mean()).transpose();
  for (Index k = 0; k < scaled.rows(); ++k) {
    const double size = scaled.row(k).norm() / std::sqrt(static_cast<double>(states.rows()));
    if (size > 0.0) scaled.row(k) /= size;
  }
  return scaled;
}

/// Of standardised states; the derivative from central differences.
double mean_period(const Matrix& points, double step) {
  const Index n = points.cols();
  const Matrix change = points.rightCols(n - 2) - points.leftCols(n - 2);
  const double rate = change.norm() / (2.0 * step);
  if (!(rate > 0.0))
    throw ArgumentError("rosenstein_divergence", "the record does not move", "");
  return 2.0 * std::numbers::pi * points.middleCols(1, n - 2).norm() / rate;
}

/// Follows pairs of samples in a record.
class Pairs {
 public:
  Pairs(const Matrix& points, Index apart, Index horizon)
      : points_(points), apart_(apart), usable_(points.cols() - horizon) {}

  Index usable() const { return usable_; }

  /// The nearest sample to i that is at least `apart` samples away and can be followed.
  Index neighbour(Index i) const {
    Index best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (Index j = 0; j < usable_; ++j) {
      if (std::abs(i - j) < apart_) continue;
      const double distance = (points_.col(i) - points_.col(j)).squaredNorm();
      if (distance < least && distance > 0.0) {
        least = distance;
        best = j;
      }
    }
    return best;
  }

  double log_distance(Index i, Index j) const {
    return 0.5 * std::log((points_.col(i) - points_.col(j)).squaredNorm());
  }

 private:
  const Matrix& points_;
  Index apart_;
  Index usable_;
};

struct Curve {
  Vector neighbours;       ///< <log d> after k samples
  double strangers = 0.0;  ///< <log d> of pairs that are half a record apart
};

Curve follow(const Pairs& pairs, Index horizon, Index references, const RunContext& context) {
  const Index count = std::min(references, pairs.usable());
  Curve curve{Vector::Zero(horizon + 1), 0.0};
  Vector parts = Vector::Zero(horizon + 1);
  for (Index r = 0; r < count; ++r) {
    context.check_stop();
    const Index i = r * pairs.usable() / count;
    curve.strangers += pairs.log_distance(i, (i + pairs.usable() / 2) % pairs.usable()) /
                       static_cast<double>(count);
    const Index j = pairs.neighbour(i);
    if (j < 0) continue;
    for (Index k = 0; k <= horizon; ++k) {
      const double distance = pairs.log_distance(i + k, j + k);
      if (!std::isfinite(distance)) continue;  // the two samples are the same
      curve.neighbours[k] += distance;
      parts[k] += 1.0;
    }
  }
  curve.neighbours.array() /= parts.array().max(1.0);
  return curve;
}

double slope(const Vector& x, const Vector& y) {
  const Vector off = x.array() - x.mean();
  return off.dot(y) / off.squaredNorm();
}

/// Last sample of the line: before the curve is half way up from sample `first`.
Index end_of_growth(const Curve& curve, Index first) {
  const double half = 0.5 * (curve.neighbours[first] + curve.strangers);
  Index last = first + 1;
  while (last + 1 < curve.neighbours.size() && curve.neighbours[last + 1] < half) ++last;
  return last;
}

}  // namespace

Divergence rosenstein_divergence(const Trajectory& record, Index references,
                                 const RunContext& context) {
  const std::optional<double> step = uniform_step(record);
  if (!step || record.samples() < 3 || references < 1)
    throw ArgumentError("rosenstein_divergence", "the record is not sampled uniformly",
                        "resample it");
  check_rows(record, "rosenstein_divergence");
  const Matrix points = standardised(record.states);
  check_argument(points.size() > 0 && points.allFinite(), "rosenstein_divergence",
                 "there is no state, or a sample or its square is not finite");
  Divergence result;
  result.mean_period = mean_period(points, *step);
  if (!(result.mean_period / *step < static_cast<double>(record.samples())))
    throw ArgumentError("rosenstein_divergence", "the record is shorter than 20 mean periods",
                        "give a longer one");
  const Index period = std::max<Index>(1, std::llround(result.mean_period / *step));
  const Index horizon = kHorizon * period;
  if (record.samples() < horizon + 5 * period)
    throw ArgumentError("rosenstein_divergence", "the record is shorter than 20 mean periods",
                        "give a longer one");
  const Curve curve = follow(Pairs(points, period, horizon), horizon, references, context);
  const Index last = end_of_growth(curve, period);
  result.time = Vector::LinSpaced(horizon + 1, 0.0, static_cast<double>(horizon) * *step);
  result.log_mean = curve.neighbours;
  result.fit_begin = result.time[period];
  result.fit_end = result.time[last];
  result.exponent = slope(result.time.segment(period, last - period + 1),
                          result.log_mean.segment(period, last - period + 1));
  return result;
}

}  // namespace lacuna
