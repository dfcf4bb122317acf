// SPDX-License-Identifier: MIT
#include "solvers/l1/l1_optimality.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/qr.hpp"

namespace lacuna {
namespace {

/// Violation up to which a point solved for exactly counts as the optimum: a fact of rounding,
/// about fifty times the distance of neighbouring doubles.
constexpr double kRoundingViolation = 1e-14;

Vector gradient(const L1Problem& problem, const Vector& z) {
  return 2.0 * problem.triangle.transpose() * (problem.target - problem.triangle * z);
}

/// Positions of the coefficients above a bound, and of those that are not penalised.
std::vector<Index> support(const L1Problem& problem, const Vector& z, double bound) {
  std::vector<Index> positions;
  for (Index j = 0; j < z.size(); ++j) {
    const bool column = problem.triangle.col(j).head(j + 1).squaredNorm() > 0.0;
    if (column && (std::abs(z[j]) > bound || problem.penalty[j] == 0.0)) positions.push_back(j);
  }
  return positions;
}

/// Stationary point with this support and the signs of `guess`; empty when not determined.
std::optional<Vector> stationary(const L1Problem& problem, const std::vector<Index>& active,
                                 const Vector& guess) {
  const auto k = static_cast<Index>(active.size());
  Vector z = Vector::Zero(guess.size());
  if (k == 0) return z;
  const Qr qr(problem.triangle(Eigen::all, active));
  const Matrix s = qr.triangle();
  if (s.diagonal().cwiseAbs().minCoeff() < 1e-13) return std::nullopt;
  const auto upper = s.triangularView<Eigen::Upper>();
  const Vector signs = guess(active).array().sign();
  const Vector shift = 0.5 * signs.cwiseProduct(problem.penalty(active));
  const Vector projected = qr.transposed_times(problem.target).col(0).head(k);
  const Vector back = upper.transpose().solve(shift);
  z(active) = Vector(upper.solve(projected - back));
  return z;
}

/// Moves z to `goal`, or up to where its first coefficient becomes zero; that one is then 0.
/// @return whether the goal was reached.
bool move_until_zero(Vector& z, const Vector& goal) {
  double step = 1.0;
  Index first = -1;
  for (Index j = 0; j < z.size(); ++j) {
    if (z[j] * goal[j] >= 0.0 || z[j] / (z[j] - goal[j]) >= step) continue;
    step = z[j] / (z[j] - goal[j]);
    first = j;
  }
  z += step * (goal - z);
  if (first >= 0) z[first] = 0.0;
  return first < 0;
}

}  // namespace

double l1_violation(const L1Problem& problem, const Vector& z) {
  const double scale = 2.0 * (problem.target.norm() + (problem.triangle * z).norm());
  if (scale == 0.0) return 0.0;
  const Vector g = gradient(problem, z);
  double worst = 0.0;
  for (Index j = 0; j < z.size(); ++j) {
    const double p = problem.penalty[j];
    const double excess = z[j] == 0.0 ? std::max(std::abs(g[j]) - p, 0.0)
                                      : std::abs(g[j] - std::copysign(p, z[j]));
    worst = std::max(worst, excess);
  }
  return worst / scale;
}

std::optional<Vector> l1_polished(const L1Problem& problem, const Vector& guess) {
  if (guess.size() == 0) return guess;
  const double largest = guess.cwiseAbs().maxCoeff();
  std::vector<Index> tried;
  for (double fraction = 0.0; fraction < 0.5;
       fraction = fraction == 0.0 ? 1e-14 : 10.0 * fraction) {
    const std::vector<Index> active = support(problem, guess, fraction * largest);
    if (fraction > 0.0 && active == tried) continue;
    tried = active;
    const std::optional<Vector> z = stationary(problem, active, guess);
    if (z && l1_violation(problem, *z) <= kRoundingViolation) return z;
  }
  return std::nullopt;
}

Vector l1_face_minimum(const L1Problem& problem, Vector z) {
  for (Index zeroed = 0; zeroed <= z.size(); ++zeroed) {
    const std::optional<Vector> goal = stationary(problem, support(problem, z, 0.0), z);
    if (!goal || move_until_zero(z, *goal)) break;
  }
  return z;
}

L1Solution l1_finished(const L1Problem& problem, const Vector& z, int iterations,
                       double tolerance) {
  if (const std::optional<Vector> exact = l1_polished(problem, z))
    return {*exact, iterations, true};
  return {z, iterations, l1_violation(problem, z) <= tolerance};
}

}  // namespace lacuna
