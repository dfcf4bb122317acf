// SPDX-License-Identifier: MIT
#include "shape_step.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

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

/// @param shapes columns of the shapes, which stand behind all that is fitted.
ShapeStep solved(const Matrix& fitted, const std::vector<Vector>& shapes,
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
  const DeterminedStep step = determined_step(normal, right, size, fit.units);
  const Vector variance = step.covariance.diagonal().tail(count);
  return {.step = step.change.tail(count),
          .deviation = variance.cwiseMax(0.0).cwiseSqrt(),
          .promised = right.dot(step.change),
          .covariance = step.covariance.topLeftCorner(fitted.cols(), fitted.cols())};
}

}  // namespace

ShapeStep shape_step(const Explanation& at, const AssimilationOptions& options) {
  const InnovationSystem system(at.fit);
  std::vector<Vector> columns;
  std::vector<std::pair<std::size_t, Index>> places;
  for (std::size_t e = 0; e < at.effects.size(); ++e) {
    if (at.effects[e].candidate.is_driven()) continue;
    for (Index s = 0; s < at.effects[e].shapes.size(); ++s)
      if (auto column = shape_column(at.effects[e], s, at.fit, system)) {
        columns.push_back(std::move(*column));
        places.emplace_back(e, s);
      }
  }
  if (columns.empty()) return {};
  ShapeStep result =
      solved(system.fitted_columns(), columns, system.innovations(), at.fit, options);
  result.places = std::move(places);
  return result;
}

}  // namespace lacuna
