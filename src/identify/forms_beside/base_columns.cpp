// SPDX-License-Identifier: MIT
#include "base_columns.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/numerics/qr.hpp"

namespace lacuna {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Of the square of a column, so much has to be new: less is rounding of a Gram matrix.
constexpr double kNewFraction = 1e-11;

/// What coefficients are worth together.
/// @param inverse (A'A)^-1.
double worth(const Vector& h, const Matrix& inverse, const std::vector<Index>& places) {
  const Eigen::LLT<Matrix> factor(Matrix(inverse(places, places)));
  if (factor.info() != Eigen::Success) return kInfinity;
  const Vector part = h(places);
  return part.dot(factor.solve(part));
}

/// What the coefficients are worth together that are worth least, chosen one by one.
double least_worth(const Vector& h, const Matrix& inverse, Index count) {
  std::vector<Index> gone;
  double least = count > h.size() ? kInfinity : 0.0;
  for (Index n = 0; n < count && std::isfinite(least); ++n) {
    least = kInfinity;
    Index next = 0;
    for (Index i = 0; i < h.size(); ++i) {
      if (std::find(gone.begin(), gone.end(), i) != gone.end()) continue;
      std::vector<Index> more = gone;
      more.push_back(i);
      const double value = worth(h, inverse, more);
      if (value < least) {
        least = value;
        next = i;
      }
    }
    gone.push_back(next);
  }
  return least;
}

}  // namespace

BaseColumns::BaseColumns(const Matrix& columns, const Vector& target) {
  if (!columns.allFinite()) {
    left_ = kInfinity;
    return;
  }
  Matrix scaled = columns;
  for (Index j = 0; j < scaled.cols(); ++j)
    scaled.col(j) /= std::max(scaled.col(j).norm(), 1e-300);
  if (scaled.cols() > 0) {
    const PivotedQr factor(scaled, kNewFraction);
    basis_ = factor.basis();
    root_ = factor.inverse_triangle();
  } else {
    basis_.resize(target.size(), 0);
    root_.resize(0, 0);
  }
  inverse_ = root_ * root_.transpose();
  const Vector projected = basis_.transpose() * target;
  h_ = root_ * projected;
  rest_ = target - basis_ * projected;
  rest_ -= basis_ * (basis_.transpose() * rest_);
  left_ = rest_.squaredNorm();
}

BaseColumns::Added BaseColumns::added(const Vector& column) const {
  const double length = column.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return {{}, 0.0, 0.0, rest_};
  const Vector unit = column / length;
  const Vector along = basis_.transpose() * unit;
  Vector fresh = unit - basis_ * along;
  fresh -= basis_ * (basis_.transpose() * fresh);
  const double size = fresh.squaredNorm();
  if (!(size > kNewFraction * kNewFraction)) return {{}, 0.0, 0.0, rest_};
  const double h = fresh.dot(rest_) / size;
  return {root_ * along, size, h, rest_ - h * fresh};
}

double BaseColumns::left_with(const Vector& column) const {
  if (!std::isfinite(left_) || !column.allFinite()) return kInfinity;
  return added(column).rest.squaredNorm();
}

Vector BaseColumns::rest_with(const Vector& column) const {
  if (!std::isfinite(left_) || !column.allFinite())
    return Vector::Constant(column.size(), kInfinity);
  return added(column).rest;
}

BaseColumns::Pair BaseColumns::with_pair(const Vector& first, const Vector& second) const {
  if (!std::isfinite(left_) || !first.allFinite() || !second.allFinite())
    return {0.0, 0.0, kInfinity};
  Matrix fresh(first.size(), 2);
  fresh << first, second;
  const Vector lengths = fresh.colwise().norm().cwiseMax(1e-300);
  fresh = fresh * lengths.cwiseInverse().asDiagonal();
  fresh -= basis_ * (basis_.transpose() * fresh);
  fresh -= basis_ * (basis_.transpose() * fresh);
  // A column that is one of the base's has nothing new, whatever rounding leaves of it.
  for (Index j = 0; j < 2; ++j)
    if (fresh.col(j).norm() < kNewFraction) fresh.col(j).setZero();
  if (fresh.isZero(0.0)) return {0.0, 0.0, left_};
  const PivotedQr factor(fresh, kNewFraction);
  const Vector h = factor.solve(rest_);
  return {h[0] / lengths[0], h[1] / lengths[1], (rest_ - fresh * h).squaredNorm()};
}

double BaseColumns::left_without(Index gone, const Vector& column) const {
  if (!std::isfinite(left_) || !column.allFinite()) return kInfinity;
  const Added more = added(column);
  if (more.size == 0.0) return kInfinity;
  const Vector h = h_ - more.h * more.along;
  const Matrix inverse = inverse_ + more.along * more.along.transpose() / more.size;
  return more.rest.squaredNorm() + least_worth(h, inverse, gone);
}

double BaseColumns::left_without(Index gone) const {
  return left_ + least_worth(h_, inverse_, gone);
}

}  // namespace lacuna
