// SPDX-License-Identifier: MIT
#include "smooth_minimum.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace lacuna {
namespace {

Vector gradient_of(FunctionRef<double(const Vector&)> function, const Vector& place,
                   const SmoothTask& task, const Matrix& curvature) {
  Vector gradient = Vector::Zero(place.size());
  for (Index i = 0; i < place.size(); ++i) {
    if (task.lower[i] == task.upper[i]) continue;
    const double step = task.difference / std::sqrt(curvature(i, i));
    Vector above = place, below = place;
    above[i] = std::min(place[i] + step, task.upper[i]);
    below[i] = std::max(place[i] - step, task.lower[i]);
    gradient[i] = (function(above) - function(below)) / (above[i] - below[i]);
  }
  return gradient;
}

/// Numbers that may move against the gradient.
std::vector<Index> movable(const Vector& place, const Vector& gradient, const SmoothTask& task) {
  std::vector<Index> free;
  for (Index i = 0; i < place.size(); ++i)
    if (task.lower[i] < task.upper[i] &&
        !(place[i] <= task.lower[i] && gradient[i] > 0.0) &&
        !(place[i] >= task.upper[i] && gradient[i] < 0.0))
      free.push_back(i);
  return free;
}

Vector newton_step(const Matrix& curvature, const Vector& gradient,
                   const std::vector<Index>& free) {
  Vector step = Vector::Zero(gradient.size());
  if (free.empty()) return step;
  const Matrix own = curvature(free, free);
  const Vector target = -gradient(free);
  const Vector found = own.ldlt().solve(target);
  step(free) = found;
  return step;
}

/// Takes the change of the gradient along a step into second derivatives; they stay positive
/// definite (BFGS, damped after Powell: Nocedal and Wright, procedure 18.2).
void learn(const Vector& step, const Vector& change, Matrix& curvature) {
  constexpr double kDamped = 0.2;
  const Vector towards = curvature * step;
  const double size = step.dot(towards);
  if (!(size > 0.0) || !change.allFinite()) return;
  const double seen = step.dot(change);
  const double fraction = seen >= kDamped * size ? 1.0 : (1.0 - kDamped) * size / (size - seen);
  const Vector damped = fraction * change + (1.0 - fraction) * towards;
  curvature += damped * damped.transpose() / step.dot(damped) -
               towards * towards.transpose() / size;
}

}  // namespace

namespace {

/// Descends from a place where the function is finite. @throws OutOfTime past the deadline.
void descend(FunctionRef<double(const Vector&)> function,
             FunctionRef<void(const Vector&)> moved, const SmoothTask& task,
             const RunContext& context, SmoothMinimum& best) {
  constexpr double kEnough = 1e-4;  // of the promised decrease: Nocedal and Wright, Sect. 3.1
  constexpr int kMostHalvings = 30;
  const auto in_time = [&](const Vector& place) {
    context.check_stop();
    return function(place);
  };
  Vector gradient = gradient_of(in_time, best.place, task, best.curvature);
  while (best.iterations < task.most_iterations && gradient.allFinite()) {
    context.check_stop();
    ++best.iterations;
    const Vector step =
        newton_step(best.curvature, gradient, movable(best.place, gradient, task));
    if (-0.5 * step.dot(gradient) < task.tolerance) {
      best.converged = true;
      break;
    }
    double fraction = 1.0, value = 0.0;
    Vector place;
    int halvings = 0;
    for (; halvings < kMostHalvings; ++halvings, fraction *= 0.5) {
      place = (best.place + fraction * step).cwiseMax(task.lower).cwiseMin(task.upper);
      value = in_time(place);
      if (value <= best.value + kEnough * gradient.dot(place - best.place)) break;
    }
    if (halvings == kMostHalvings) {
      constexpr double kNoticed = 1e-3;  // of twice a log-likelihood
      best.converged = -0.5 * step.dot(gradient) < kNoticed;
      break;
    }
    const Vector before = std::exchange(best.place, place);
    best.value = value;
    moved(place);
    const Vector next = gradient_of(in_time, place, task, best.curvature);
    learn(place - before, next - gradient, best.curvature);
    gradient = next;
  }
}

}  // namespace

SmoothMinimum minimise_smooth(FunctionRef<double(const Vector&)> function,
                              FunctionRef<void(const Vector&)> moved, const SmoothTask& task,
                              const RunContext& context) {
  SmoothMinimum best{task.start.cwiseMax(task.lower).cwiseMin(task.upper), 0.0, task.curvature};
  moved(best.place);
  best.value = function(best.place);
  if (!std::isfinite(best.value)) return best;
  try {
    descend(function, moved, task, context, best);
  } catch (const OutOfTime&) {
    best.in_time = false;
  }
  return best;
}

Matrix second_derivatives(FunctionRef<double(const Vector&)> function, const Vector& place,
                          const Vector& steps, const RunContext& context) {
  Matrix curvature = Matrix::Zero(place.size(), place.size());
  const auto at = [&](Index i, double a, Index j, double b) {
    Vector moved = place;
    moved[i] += a * steps[i];
    moved[j] += b * steps[j];
    context.check_stop();
    return function(moved);
  };
  const double here = function(place);
  for (Index i = 0; i < place.size(); ++i) {
    context.check_stop();
    if (!(steps[i] > 0.0)) continue;
    curvature(i, i) =
        (at(i, 1.0, i, 0.0) - 2.0 * here + at(i, -1.0, i, 0.0)) / (steps[i] * steps[i]);
    for (Index j = 0; j < i; ++j) {
      if (!(steps[j] > 0.0)) continue;
      curvature(i, j) = curvature(j, i) = (at(i, 1.0, j, 1.0) - at(i, 1.0, j, -1.0) -
                                           at(i, -1.0, j, 1.0) + at(i, -1.0, j, -1.0)) /
                                          (4.0 * steps[i] * steps[j]);
    }
  }
  return curvature;
}

}  // namespace lacuna
