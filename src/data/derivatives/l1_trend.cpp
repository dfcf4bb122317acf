// SPDX-License-Identifier: MIT
#include "data/derivatives/l1_trend.hpp"

#include <algorithm>
#include <limits>

#include "core/base/check.hpp"

namespace lacuna {
namespace {

// Decisions: the gap at which more steps change nothing that anybody sees; where steps end
// whatever they reach; the fraction of the complementarity that a step aims at, and of the way to
// the bounds that it goes; the fraction of its bound from which v belongs to a knot.
constexpr double kGap = 1e-7;
constexpr int kMostSteps = 100;
constexpr double kCentring = 0.1;
constexpr double kToBounds = 0.99;
constexpr double kAtBound = 0.99;

/// The least v'D D'v - 2 v'D y with |v| <= bound, by Newton's steps on its conditions.
struct DualProblem {
  const SparseRows& gram;  ///< D D'
  const Vector& right;     ///< D y
  double bound;
};

struct DualPoint {
  Vector v;
  Vector upper, lower;  ///< multipliers of v <= bound and -v <= bound
};

/// The largest step, at most 1, that keeps a + step * change positive.
double step_within(const Vector& a, const Vector& change) {
  double step = 1.0;
  for (Index i = 0; i < a.size(); ++i)
    if (change[i] < 0.0) step = std::min(step, -kToBounds * a[i] / change[i]);
  return step;
}

Vector newton_step(const DualProblem& problem, const Vector& slope, const Vector& right) {
  SparseRows matrix = 2.0 * problem.gram;
  for (Index i = 0; i < slope.size(); ++i) matrix.coeffRef(i, i) += slope[i];
  const SparseRows lower = sparse_cholesky(matrix);
  Vector step = solve_by_factor(lower, right);
  step += solve_by_factor(lower, right - matrix * step);  // ill-conditioned in long records
  return step;
}

void improve(const DualProblem& problem, DualPoint& at) {
  const Vector above = problem.bound - at.v.array(), below = problem.bound + at.v.array();
  const double complementarity =
      (at.upper.dot(above) + at.lower.dot(below)) / static_cast<double>(2 * at.v.size());
  const Vector aim_upper = kCentring * complementarity * above.cwiseInverse();
  const Vector aim_lower = kCentring * complementarity * below.cwiseInverse();
  const Vector slope_upper = at.upper.cwiseQuotient(above);
  const Vector slope_lower = at.lower.cwiseQuotient(below);
  const Vector change =
      newton_step(problem, slope_upper + slope_lower,
                  2.0 * (problem.right - problem.gram * at.v) - aim_upper + aim_lower);
  const Vector change_upper = aim_upper - at.upper + slope_upper.cwiseProduct(change);
  const Vector change_lower = aim_lower - at.lower - slope_lower.cwiseProduct(change);
  const double step = std::min({step_within(above, -change), step_within(below, change),
                                step_within(at.upper, change_upper),
                                step_within(at.lower, change_lower)});
  at.v += step * change;
  at.upper += step * change_upper;
  at.lower += step * change_lower;
}

}  // namespace

L1Trend l1_trend(const SparseRows& differences, const Vector& values, double weight) {
  check_argument(differences.cols() == values.size() && weight > 0.0, "l1_trend",
                 "the differences do not fit the samples or the weight is not positive");
  const SparseRows gram = differences * SparseRows(differences.transpose());
  const Vector right = differences * values;
  const double size = right.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return {values, 0, 0.0};
  const DualProblem problem{gram, right, 0.5 * weight};
  DualPoint at{Vector::Zero(right.size()), Vector::Constant(right.size(), size),
               Vector::Constant(right.size(), size)};
  L1Trend best{values, 0, std::numeric_limits<double>::infinity()};
  for (int step = 0; step < kMostSteps; ++step) {
    improve(problem, at);
    const Vector rest = differences.transpose() * at.v;
    const double objective =
        rest.squaredNorm() + weight * (right - gram * at.v).cwiseAbs().sum();
    const double gap = objective - (2.0 * at.v.dot(right) - rest.squaredNorm());
    if (!(gap < best.gap)) break;  // rounding decides from here on
    best = {values - rest, (at.v.array().abs() > kAtBound * problem.bound).count(), gap};
    if (gap <= kGap * objective) break;
  }
  return best;
}

}  // namespace lacuna
