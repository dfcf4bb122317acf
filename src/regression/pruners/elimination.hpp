// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna {

/// One state of a backward elimination: the terms still there and the regressor's fit in them.
/// A value; taking a term out gives a new one at O(L^2) besides the fit itself, and at O(L^3)
/// where terms nearly depend on one another.
class Elimination {
 public:
  /// Fits all active terms. The regressor, the system and the context must outlive it.
  Elimination(const LeastSquaresSystem& system, Index target, const TermSet& active,
              const Regressor& regressor, const RunContext& context);

  const TermSet& active() const noexcept { return problem_.active(); }
  Index size() const noexcept { return problem_.size(); }
  Index rows() const noexcept { return problem_.rows(); }                 ///< n
  double target_norm() const noexcept { return problem_.target_norm(); }  ///< |y|
  double residual_norm() const noexcept { return residual_norm_; }        ///< |y - Theta_A h|

  /// h, one per active term; 0 for those that a sparse regressor dropped.
  const Vector& coefficients() const noexcept { return coefficients_; }

  /// |h_i theta_i|, one per active term, in units of |y|.
  Vector contributions() const;

  /// |h_i| / sqrt([(Theta_A'Theta_A)^-1]_ii), one per active term: the square root of what the
  /// sum of squared residuals gains when the term is taken out of a least-squares fit. 0 for
  /// terms that the data do not determine.
  Vector losses() const;

  /// Without the terms at these positions of active(), fitted anew.
  Elimination without(const std::vector<Index>& positions) const;

 private:
  void fit();

  const LeastSquaresSystem* system_;
  const Regressor* regressor_;
  const RunContext* context_;
  Subproblem problem_;
  Vector inverse_diagonal_;  ///< of (R'R)^-1, whose columns have unit norm
  Vector coefficients_;
  double residual_norm_ = 0.0;
};

/// |h_i| / sqrt([(Theta_A'Theta_A)^-1]_ii) as Elimination::losses().
Vector losses(const Subproblem& problem, const Vector& coefficients);

/// Position of the smallest number. @pre not empty.
Index smallest(const Vector& values);

}  // namespace lacuna
