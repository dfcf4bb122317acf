// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <utility>

#include "lacuna/core/base/types.hpp"
#include "lacuna/regression/linear/factor.hpp"
#include "regression/linear/triangular.hpp"

namespace lacuna {

/// The least-squares problem of one target in a set A of active terms, as a triangular system:
///
///   min_h |y - Theta_A h|^2 = min_h |c - R D h|^2 + rho^2
///
/// with R (|A| x |A|) upper triangular, D the norms of the columns, rho the residual that no h
/// removes. Terms leave it by Givens rotations. A value of its own: it does not refer to the
/// rows. Coefficients h are in the units of the data everywhere; scaling is inside.
class Subproblem {
 public:
  /// Restricts a factor of all terms to one target and the active terms: O(L |A|^2), O(|A|^2)
  /// when these are the first |A| terms.
  /// @throws ArgumentError when a number is out of range or the set is not increasing.
  Subproblem(const Factor& factor, Index target, TermSet active);

  Index target() const noexcept { return target_; }
  const TermSet& active() const noexcept { return active_; }
  Index size() const noexcept { return static_cast<Index>(active_.size()); }
  Index rows() const noexcept { return rows_; }
  double target_norm() const noexcept { return target_norm_; }  ///< |y|

  /// Norms |theta_j| of the active columns (for a weighted problem: of the weighted columns).
  const Vector& column_norms() const noexcept { return column_norms_; }

  /// R: upper triangular, columns scaled to unit norm.
  const Matrix& triangle() const noexcept { return triangle_; }

  /// c: the target in the coordinates of R.
  const Vector& projected_target() const noexcept { return projected_target_; }

  /// Least-squares coefficients, (7) of Karimov et al. 2023. Directions that the data do not
  /// determine (|R_ii| below rounding) get coefficient 0: of terms that depend on each other
  /// the last does.
  Vector solve() const;

  /// Solves R'R dh = g for a gradient g = Theta_A' r (refinement). Coefficients that solve()
  /// sets to 0 do not change.
  /// @throws ArgumentError unless there is one entry per active term.
  Vector solve_normal(const Vector& gradient) const;

  /// |y - Theta_A h| of the least-squares solution; O(|A|^3) where terms depend on each other.
  double residual_norm() const;

  /// |y - Theta_A h| of any h.
  /// @throws ArgumentError unless there is one entry per active term.
  double residual_norm(const Vector& h) const;

  /// Takes the term at a position of active() out: O(|A|^2).
  /// @throws ArgumentError when there is no such position.
  void remove(Index position);

  /// Estimate of the condition number of the scaled columns (1-norm).
  double condition() const;

  /// Diagonal of (Theta_A' Theta_A)^-1: times the residual variance, the variance of each
  /// coefficient. Infinite where the data do not determine one.
  Vector inverse_gram_diagonal() const;

  /// The same problem under other numbers of its target and its terms, for a problem whose rows
  /// were made from some columns of another.
  /// @param active as many numbers as size().
  Subproblem renumbered(Index target, TermSet active) const;

 private:
  void set_problem(TriangularProblem problem);
  bool is_rank_deficient() const;
  std::pair<TriangularProblem, TermSet> determined_part() const;

  TermSet active_;
  Index target_ = 0;
  Index rows_ = 0;
  double target_norm_ = 0.0;
  double remainder_ = 0.0;  // rho
  Vector column_norms_;
  Matrix triangle_;
  Vector projected_target_;
};

}  // namespace lacuna
