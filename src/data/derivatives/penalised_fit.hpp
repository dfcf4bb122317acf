// SPDX-License-Identifier: MIT
#pragma once

#include "core/numerics/sparse_cholesky.hpp"
#include "data/derivatives/penalty_choice.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// min over c of |y - H c|^2 + lambda c'P c.
struct PenalisedProblem {
  SparseRows design;     ///< H, n x K, its rows narrow
  SparseRows penalty;    ///< P, K x K, both triangles
  Index null_space = 0;  ///< dimension of the c with P c = 0
};

/// Its solution for the m columns of y.
struct PenalisedFit {
  Matrix coefficients;     ///< K x m
  Matrix inverse;          ///< inverse_band() of H'H + lambda P
  Vector squares;          ///< m, RSS = |y - H c|^2
  Vector penalised;        ///< m, y'(y - H c)
  double trace;            ///< of the matrix S that takes y to H c
  double log_determinant;  ///< of H'H + lambda P
};

/// By one sparse Cholesky factor. @param values n x m; @param lambda > 0.
/// @throws ArgumentError when shapes do not fit or the matrix is singular.
PenalisedFit fit_penalised(const PenalisedProblem& problem, const Matrix& values, double lambda);

/// The one lambda for all columns for which the sum of their criteria is least: log GCV, -2 log
/// likelihood with the noise of each column profiled out, or Mallows' C_p. One lambda, because
/// signals that go through unequal filters bias the coefficients of equations between them. By
/// decades from `least` to `largest`, then by golden section.
/// @param noise m standard deviations, for PenaltyChoice::Noise.
double choose_lambda(const PenalisedProblem& problem, const Matrix& values,
                     PenaltyChoice choice, const Vector& noise, double least, double largest);

/// Standard deviation of each column's noise that a fit leaves: sqrt(RSS / (n - tr S)).
Vector remaining_noise(const PenalisedFit& fit, Index samples);

/// a_i'(H'H + lambda P)^-1 a_i for each row a_i of A, which is not wider than the band.
Vector row_variances(const PenalisedFit& fit, const SparseRows& rows);

}  // namespace lacuna
