// SPDX-License-Identifier: MIT
#include "record_spread.hpp"

#include "core/numerics/singular_values.hpp"
#include "trajectories/shooting/shooting_problem.hpp"

namespace lacuna {
namespace {

/// Directions of the shared numbers of which nothing is known, as changes, G x d.
Matrix open_changes(const FitUnknowns& unknowns, const FitErrors& errors,
                    const FitPoint& point) {
  Matrix open = errors.open;
  for (Index i = 0; i < open.rows(); ++i)
    open.row(i) *= point.parameters(0, unknowns.global[static_cast<std::size_t>(i)]);
  return open;
}

/// The inverse of a square matrix where it has one, and what it maps to nothing. Columns count
/// by their own sizes: numbers have units.
struct Inverse {
  Matrix inverse, unseen;
};

Inverse inverse_of(const Matrix& own) {
  constexpr double kRank = 1e-9;  // of a column that shows nothing else: rounding makes 1e-15
  Vector sizes = own.colwise().norm().transpose();
  for (double& size : sizes) size = size > 0.0 ? 1.0 / size : 1.0;
  const SingularValues parts = singular_values(own * sizes.asDiagonal());
  const Index rank = parts.rank(kRank);
  const Vector values = parts.values.head(rank).cwiseInverse();
  return {sizes.asDiagonal() * parts.right.leftCols(rank) * values.asDiagonal() *
              parts.left.leftCols(rank).transpose(),
          sizes.asDiagonal() * parts.null_space(kRank)};
}

/// Rows and columns of a part put among all of them.
Matrix spread_out(const Matrix& part, const std::vector<Index>& rows, Index all) {
  Matrix whole = Matrix::Zero(all, part.cols());
  whole(rows, Eigen::all) = part;
  return whole;
}

}  // namespace

RecordSpread spread_of_record(const FitEngine& engine, const FitUnknowns& unknowns,
                              const FitLinear& linear, const FitErrors& errors,
                              const FitPoint& point, Index record) {
  const Matrix& triangle = linear.records[static_cast<std::size_t>(record)];
  const Index g = errors.covariance.rows(), locals = triangle.cols() - 1 - g;
  const auto [inverse, unseen] = inverse_of(triangle.topLeftCorner(locals, locals));
  const Matrix carried = inverse * triangle.block(0, locals, locals, g);
  const Matrix shared = open_changes(unknowns, errors, point);
  Matrix covariance(locals + g, locals + g);
  covariance << inverse * inverse.transpose() +
                    carried * errors.covariance * carried.transpose(),
      -carried * errors.covariance, -errors.covariance * carried.transpose(),
      errors.covariance;
  Matrix open = Matrix::Zero(locals + g, unseen.cols() + shared.cols());
  open.topLeftCorner(locals, unseen.cols()) = unseen;
  open.topRightCorner(locals, shared.cols()) = -carried * shared;
  open.bottomRightCorner(g, shared.cols()) = shared;
  for (Index k = 0; k < engine.states(); ++k) {
    const auto& initial = unknowns.initial[static_cast<std::size_t>(k)];
    if (initial && initial->fixed) open.row(k).setZero();
  }
  const std::vector<Index> order = column_order(engine, unknowns);
  const Index all = engine.states() + engine.parameters();
  const Matrix half = spread_out(covariance, order, all);
  return {spread_out(half.transpose(), order, all), spread_out(open, order, all)};
}

NumberSpread spread_of_numbers(const FitEngine& engine, const FitUnknowns& unknowns,
                               const FitErrors& errors, const FitPoint& point) {
  const Index all = engine.parameters();
  const Matrix half = spread_out(errors.covariance, unknowns.global, all);
  return {spread_out(half.transpose(), unknowns.global, all),
          spread_out(open_changes(unknowns, errors, point), unknowns.global, all)};
}

}  // namespace lacuna
