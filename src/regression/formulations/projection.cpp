// SPDX-License-Identifier: MIT
#include "regression/formulations/projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/check.hpp"
#include "core/numerics/sparse_cholesky.hpp"

namespace lacuna {
namespace {

using Triplets = std::vector<Eigen::Triplet<double, Index>>;

/// A fact of memory: more rows than this have no room.
constexpr double kMostRows = 1e8;

/// Gauss-Legendre points and weights on (0, 1), exact for cubics.
constexpr double kGauss[2] = {0.21132486540518713, 0.7886751345948129};

/// Adds the integral over (t_i, t_i+1) of the polynomial through the samples from `first` on.
void add_interval(const Vector& time, Index i, Index first, Index points, Vector& weights) {
  const double h = time[i + 1] - time[i];
  for (const double place : kGauss) {
    const double at = time[i] + place * h;
    for (Index j = first; j < first + points; ++j) {
      double basis = 1.0;
      for (Index k = first; k < first + points; ++k)
        if (k != j) basis *= (at - time[k]) / (time[j] - time[k]);
      weights[j] += 0.5 * h * basis;
    }
  }
}

SparseRows assemble_rows(Index rows, Index columns, const Triplets& entries) {
  SparseRows matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Index first_after(const Vector& time, double t) {
  return std::upper_bound(time.data(), time.data() + time.size(), t) - time.data();
}

/// Added to the diagonal of a covariance, of its mean: rows that nearly depend on each other do
/// not become arbitrarily large. A fact of rounding.
constexpr double kRounding = 1e-10;

}  // namespace

double TestFunction::value(double t) const {
  const double u = t / radius;
  return std::abs(u) < 1.0 ? std::pow(1.0 - u * u, order) : 0.0;
}

double TestFunction::slope(double t) const {
  const double u = t / radius;
  return std::abs(u) < 1.0 ? -2.0 * order * u / radius * std::pow(1.0 - u * u, order - 1) : 0.0;
}

Matrix Projection::covariance(Index first, Index count, const Matrix& sensitivity,
                              const Vector& noise, Index state) const {
  check_part(first, count, rows(), "Projection::covariance");
  const bool fits = sensitivity.size() == 0 ||
                    (sensitivity.rows() == values.cols() && sensitivity.cols() >= noise.size());
  check_argument(fits, "Projection::covariance", "sensitivity and noise do not fit");
  Matrix total = Matrix::Zero(count, count);
  const SparseRows term_rows = values.middleRows(first, count);
  const SparseRows state_rows = rates.middleRows(first, count);
  for (Index j = 0; j < noise.size(); ++j) {
    SparseRows response(count, term_rows.cols());
    if (sensitivity.size() > 0) response = term_rows * sensitivity.col(j).asDiagonal();
    if (j == state) response -= state_rows;
    total += noise[j] * noise[j] * Matrix(response * SparseRows(response.transpose()));
  }
  return total;
}

SparseRows Projection::target_factor(Index first, Index count) const {
  check_part(first, count, rates.rows(), "Projection::target_factor");
  if (count == 0) return SparseRows(0, 0);
  const SparseRows part = rates.middleRows(first, count);
  SparseRows covariance = part * SparseRows(part.transpose());
  const double mean = covariance.diagonal().sum() / static_cast<double>(count);
  for (Index row = 0; row < count; ++row) covariance.coeffRef(row, row) += kRounding * mean;
  return sparse_cholesky(covariance);
}

Vector quadrature_weights(const Vector& time) {
  check_times(time, 0, "quadrature_weights");
  const Index n = time.size();
  const Index points = std::min<Index>(n, 4);
  Vector weights = Vector::Zero(n);
  for (Index i = 0; i + 1 < n; ++i)
    add_interval(time, i, std::clamp<Index>(i - 1, 0, n - points), points, weights);
  return weights;
}

Projection weak_projection(const Trajectory& record, const TestFunction& function,
                           double spacing) {
  const Vector& time = record.time;
  check_times(time, 1, "weak_projection");
  check_argument(function.radius > 0.0 && function.order >= 2 && spacing > 0.0 &&
                     record.duration() / spacing < kMostRows,
                 "weak_projection", "there are no such test functions",
                 "give a radius and a spacing above 0");
  const Index n = record.samples();
  const double room = time[n - 1] - time[0] - 2.0 * function.radius;
  const Index rows = room >= 0.0 ? static_cast<Index>(room / spacing) + 1 : 0;
  const Vector weights = quadrature_weights(time);
  Triplets values, rates;
  for (Index row = 0; row < rows; ++row) {
    const double centre = time[0] + function.radius + spacing * static_cast<double>(row);
    for (Index i = first_after(time, centre - function.radius);
         i < n && time[i] < centre + function.radius; ++i) {
      values.emplace_back(row, i, weights[i] * function.value(time[i] - centre));
      rates.emplace_back(row, i, -weights[i] * function.slope(time[i] - centre));
    }
  }
  return {assemble_rows(rows, n, values), assemble_rows(rows, n, rates)};
}

Projection integral_projection(const Trajectory& record, Index span, Index stride) {
  check_times(record.time, 0, "integral_projection");
  check_argument(span >= 1 && stride >= 1, "integral_projection",
                 "an integral has no span or no stride");
  const Index n = record.samples();
  if (span >= n) return {SparseRows(0, n), SparseRows(0, n)};
  stride = std::min(stride, n);
  Triplets values, rates;
  Index rows = 0;
  for (Index first = 0; first + span < n; first += stride, ++rows) {
    const Vector weights = quadrature_weights(record.time.segment(first, span + 1));
    for (Index i = 0; i <= span; ++i) values.emplace_back(rows, first + i, weights[i]);
    rates.emplace_back(rows, first, -1.0);
    rates.emplace_back(rows, first + span, 1.0);
  }
  return {assemble_rows(rows, n, values), assemble_rows(rows, n, rates)};
}

}  // namespace lacuna
