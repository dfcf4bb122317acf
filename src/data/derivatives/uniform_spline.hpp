// SPDX-License-Identifier: MIT
#pragma once

#include "core/numerics/sparse_cholesky.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Splines of degree p on equal intervals: sum_j c_j B_j(t), with p + intervals functions of
/// which p + 1 are not 0 in each interval (C. de Boor, A Practical Guide to Splines, 2001).
struct UniformSpline {
  double first = 0.0;    ///< time of the first knot
  double spacing = 1.0;  ///< of the knots
  Index intervals = 1;
  int degree = 5;

  Index functions() const { return intervals + degree; }  ///< number of coefficients
};

/// Of equal intervals over the times: about one for each sample. @throws ArgumentError for fewer
/// than two times or times that do not increase.
UniformSpline spline_over(const Vector& time, int degree);

/// n x functions: the k-th derivatives of all functions at given times, in 1 / time^k.
SparseRows spline_rows(const UniformSpline& spline, const Vector& time, int order);

/// P with c'P c = integral of (d^m/dt^m sum_j c_j B_j)^2, exact by Gauss-Legendre points.
SparseRows spline_penalty(const UniformSpline& spline, int order);

}  // namespace lacuna
