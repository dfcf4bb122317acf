// SPDX-License-Identifier: MIT
#include "gauss_newton.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/numerics/qr.hpp"

namespace lacuna {
namespace {

/// A point of the cube with its residuals.
struct PointInCube {
  Vector point, residuals;

  double squares() const { return residuals.squaredNorm(); }
  bool is_finite() const { return std::isfinite(squares()); }
};

/// K x d, by differences that stay in the cube.
Matrix differences(FunctionRef<Vector(const Vector&)> residuals, const PointInCube& at) {
  // A fact of rounding: half the digits are left to the difference.
  constexpr double kStep = 1e-6;
  Matrix jacobian(at.residuals.size(), at.point.size());
  for (Index i = 0; i < at.point.size(); ++i) {
    const double step = at.point[i] + kStep <= 1.0 ? kStep : -kStep;
    Vector beside = at.point;
    beside[i] += step;
    jacobian.col(i) = (residuals(beside) - at.residuals) / step;
  }
  return jacobian;
}

/// The coordinates that a step down may change: no face is in the way.
std::vector<Index> free_coordinates(const PointInCube& at, const Vector& gradient) {
  std::vector<Index> free;
  for (Index i = 0; i < gradient.size(); ++i) {
    const bool is_held = (at.point[i] <= 0.0 && gradient[i] > 0.0) ||
                         (at.point[i] >= 1.0 && gradient[i] < 0.0);
    if (!is_held) free.push_back(i);
  }
  return free;
}

/// The step of the linearised problem; empty where the residuals do not determine it.
Vector step_of(const Matrix& jacobian, const Vector& residuals) {
  // A fact of rounding: columns that differ by less are one.
  constexpr double kIndependent = 1e-9;
  const Vector sizes = jacobian.colwise().norm();
  if (!(sizes.minCoeff() > 0.0) || !sizes.allFinite()) return {};
  const PivotedQr factor(jacobian * sizes.cwiseInverse().asDiagonal(), kIndependent);
  if (factor.rank() < jacobian.cols()) return {};
  return -(factor.solve(residuals).array() / sizes.array()).matrix();
}

/// How far a search got by one step.
enum class Progress { Down, Converged, None };

Progress take_step_down(FunctionRef<Vector(const Vector&)> residuals,
                        const GaussNewtonSettings& settings, PointInCube& at) {
  const Matrix jacobian = differences(residuals, at);
  const Vector gradient = jacobian.transpose() * at.residuals;
  const std::vector<Index> free = free_coordinates(at, gradient);
  if (free.empty()) return Progress::Converged;
  const Vector part = step_of(jacobian(Eigen::all, free), at.residuals);
  if (part.size() == 0) return Progress::None;
  const double before = at.squares();
  // |r|^2 - |r + J d|^2 = -r'J d for the step of least squares.
  const double gain = -gradient(free).dot(part);
  if (gain <= settings.unnoticed * before) return Progress::Converged;
  if (settings.wanted > 0.0 && is_far_above(before, settings.wanted) && gain < 0.5 * before)
    return Progress::None;
  Vector step = Vector::Zero(at.point.size());
  step(free) = part * std::min(1.0, settings.reach / part.cwiseAbs().maxCoeff());
  constexpr int kHalvings = 6;  // a fact of the search: shorter steps go nowhere
  for (int halving = 0; halving <= kHalvings; ++halving, step *= 0.5) {
    PointInCube next{(at.point + step).cwiseMax(0.0).cwiseMin(1.0), {}};
    next.residuals = residuals(next.point);
    if (!next.is_finite() || !(next.squares() < before)) continue;
    at = std::move(next);
    const bool is_noticed = before - at.squares() > settings.unnoticed * before;
    return is_noticed ? Progress::Down : Progress::Converged;
  }
  return Progress::None;
}

}  // namespace

CubeMinimum gauss_newton(FunctionRef<Vector(const Vector&)> residuals, const Vector& start,
                         const GaussNewtonSettings& settings) {
  PointInCube at{start.cwiseMax(0.0).cwiseMin(1.0), {}};
  at.residuals = residuals(at.point);
  Progress progress = at.is_finite() ? Progress::Down : Progress::None;
  for (int step = 0; step < settings.steps && progress == Progress::Down; ++step)
    progress = take_step_down(residuals, settings, at);
  const double squares = at.squares();
  return {std::move(at.point), squares, progress == Progress::Converged};
}

}  // namespace lacuna
