// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include "core/numerics/sparse_cholesky.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// A smooth test function of compact support,
///   phi(t) = (1 - (t / radius)^2)^order for |t| < radius, else 0.
struct TestFunction {
  double radius = 1.0;  ///< time units
  int order = 2;        ///< >= 2; the higher, the smoother at the ends of the support

  double value(double t) const;  ///< phi(t)
  double slope(double t) const;  ///< phi'(t)
};

/// Linear functionals of a record: K rows that turn samples into equations without a
/// derivative,
///
///   sum_j h_j (values theta_j)_i = (rates x)_i,   i = 1..K,
///
/// with theta_j the n samples of a term and x those of the state. White noise of standard
/// deviation sigma on x gives (rates x) the covariance sigma^2 rates rates'.
struct Projection {
  SparseRows values;  ///< K x n, of the terms
  SparseRows rates;   ///< K x n, of the state whose equation it is

  Index rows() const noexcept { return values.rows(); }

  /// Covariance of the residuals values theta h - rates x of rows first .. first + count - 1
  /// when the noise of the samples enters the terms too: to first order
  ///   C = sum_j sigma_j^2 A_j A_j',  A_j = values diag(g_j) - [j = state] rates.
  /// @param sensitivity n x m, df/dx_j of the equation's right-hand side at the samples (0 x 0:
  ///   noise of the terms is not counted); @param noise sigma, m; @param state whose equation.
  /// @throws ArgumentError when there are no such rows, or the shapes do not fit.
  Matrix covariance(Index first, Index count, const Matrix& sensitivity, const Vector& noise,
                    Index state) const;

  /// Factor L of rates rates' = L L' of rows first .. first + count - 1, lower triangular and
  /// as banded as the supports overlap: L^-1 makes rows white that have noise in the state
  /// only.
  /// @throws ArgumentError when there are no such rows.
  SparseRows target_factor(Index first, Index count) const;
};

/// Rows for test functions that fit into the record, `spacing` time units apart: values are
/// phi(t - c), rates -phi'(t - c), each times quadrature weights. The record need not be
/// uniform: the weights integrate the cubic through four samples over each interval (h in the
/// middle of a uniform record, where such sums converge faster than any power of h).
/// @return no rows where the record is shorter than the support.
/// @throws ArgumentError when times do not increase, or there is no such test function.
Projection weak_projection(const Trajectory& record, const TestFunction& function,
                           double spacing);

/// Rows for intervals of `span` samples, one from every `stride`-th sample: values are
/// quadrature weights of the integral, rates are the difference of the ends.
/// @throws ArgumentError when times do not increase, or span or stride are not above 0.
Projection integral_projection(const Trajectory& record, Index span, Index stride);

/// Weights w of the rule sum_i w_i f(t_i) for the integral over a stretch of samples, exact for
/// cubics (for polynomials through all samples where there are fewer than four).
/// @throws ArgumentError when times do not increase.
Vector quadrature_weights(const Vector& time);

}  // namespace lacuna
