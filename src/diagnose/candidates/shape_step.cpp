// SPDX-License-Identifier: MIT
#include "shape_step.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "diagnose/candidates/candidate_column.hpp"
#include "trajectories/smoother/determined_step.hpp"

namespace lacuna {
namespace {

/// d(column)/d(shape) times the coefficient, by central differences inside the range.
std::optional<Vector> shape_column(const FittedEffect& effect, Index shape,
                                   const Assimilation& fit, const InnovationSystem& system) {
  const ShapeParameter& range = effect.candidate.shapes[static_cast<std::size_t>(shape)];
  const double value = effect.shapes[shape];
  const double reach =
      1e-3 * (range.logarithmic ? std::abs(value) : std::abs(range.high - range.low));
  Vector low = effect.shapes, high = effect.shapes;
  low[shape] = std::max(range.low, value - reach);
  high[shape] = std::min(range.high, value + reach);
  if (!(high[shape] > low[shape])) return std::nullopt;
  const auto size = static_cast<std::size_t>(low.size());
  const auto below = candidate_column(effect.candidate, {low.data(), size}, fit, system);
  const auto above = candidate_column(effect.candidate, {high.data(), size}, fit, system);
  if (!below || !above) return std::nullopt;
  return Vector(effect.coefficient / (high[shape] - low[shape]) * (*above - *below));
}

/// Least squares of everything that is fitted, then of shapes.
struct JointProblem {
  Matrix normal;
  Vector right, size;
  const std::vector<Index>& units;

  DeterminedStep solved(const std::vector<Index>& kept) const {
    return determined_step(normal(kept, kept), right(kept), size(kept), units);
  }
};

/// @param shapes columns of the shapes, which stand behind all that is fitted.
JointProblem joint_problem(const Matrix& fitted, const std::vector<Vector>& shapes,
                           const Vector& innovations, const Assimilation& fit,
                           const AssimilationOptions& options) {
  const auto count = static_cast<Index>(shapes.size());
  Matrix columns(fitted.rows(), fitted.cols() + count);
  columns.leftCols(fitted.cols()) = fitted;
  for (Index j = 0; j < count; ++j)
    columns.col(fitted.cols() + j) = shapes[static_cast<std::size_t>(j)];
  Vector size = Vector::Zero(columns.cols());
  size.head(fitted.cols()) = sizes_of(fit, options.held_among);
  Matrix normal = columns.transpose() * columns;
  Vector right = columns.transpose() * innovations;
  add_priors(fit, options.priors, normal, right);
  return {std::move(normal), std::move(right), std::move(size), fit.units};
}

/// Whether a shape stands at the end of its range that a step would take it beyond.
bool is_held(const FittedEffect& effect, Index shape, double step) {
  const ShapeParameter& range = effect.candidate.shapes[static_cast<std::size_t>(shape)];
  const double value = effect.shapes[shape];
  return (step < 0.0 && value <= range.low) || (step > 0.0 && value >= range.high);
}

/// The step of the others where shapes at the ends of their ranges would leave these.
void stay_in_ranges(const Explanation& at, const JointProblem& problem, Index fitted,
                    ShapeStep& result) {
  std::vector<Index> kept(static_cast<std::size_t>(problem.right.size()));
  std::iota(kept.begin(), kept.end(), Index{0});
  const auto leaves = [&](Index row) {
    if (row < fitted) return false;
    const auto [effect, shape] = result.places[static_cast<std::size_t>(row - fitted)];
    return is_held(at.effects[effect], shape, result.step[row - fitted]);
  };
  while (std::erase_if(kept, leaves) > 0) {
    const Vector change = problem.solved(kept).change;
    result.step.setZero();
    for (std::size_t j = 0; j < kept.size(); ++j)
      if (kept[j] >= fitted) result.step[kept[j] - fitted] = change[static_cast<Index>(j)];
    result.promised = problem.right(kept).dot(change);
  }
}

}  // namespace

ShapeStep shape_step(const Explanation& at, const AssimilationOptions& options) {
  const InnovationSystem system(at.fit);
  std::vector<Vector> columns;
  ShapeStep result;
  for (std::size_t e = 0; e < at.effects.size(); ++e) {
    if (at.effects[e].candidate.is_driven()) continue;
    for (Index s = 0; s < at.effects[e].shapes.size(); ++s)
      if (auto column = shape_column(at.effects[e], s, at.fit, system)) {
        columns.push_back(std::move(*column));
        result.places.emplace_back(e, s);
      }
  }
  if (columns.empty()) return {};
  const Matrix others = system.fitted_columns();
  const JointProblem problem =
      joint_problem(others, columns, system.innovations(), at.fit, options);
  const DeterminedStep all =
      determined_step(problem.normal, problem.right, problem.size, problem.units);
  const auto count = static_cast<Index>(columns.size());
  const Index fitted = others.cols();
  result.step = all.change.tail(count);
  result.deviation = all.covariance.diagonal().tail(count).cwiseMax(0.0).cwiseSqrt();
  result.promised = problem.right.dot(all.change);
  result.covariance = all.covariance.topLeftCorner(fitted, fitted);
  if (result.step.allFinite()) stay_in_ranges(at, problem, fitted, result);
  return result;
}

}  // namespace lacuna
