// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/regression/linear/factor.hpp"
#include "lacuna/regression/linear/row_source.hpp"
#include "regression/linear/weighted_rows.hpp"

namespace lacuna {

class Subproblem;

/// The linear problem Theta h_k ~ y_k for k = 1..m that every filter, regressor and pruner
/// works on. Owns a row source and the statistics of its rows, never the n x L matrix.
///
/// Rows are read in tiles and folded in a fixed order, so the result does not depend on the
/// number of threads. Folding is by the Gram matrix (scaled, Cholesky); where its scaled
/// condition exceeds about 1e7, where Cholesky breaks down, or where the residual lies below
/// what a Gram can resolve, it is repeated by tall-skinny QR (see factorise()). A value: copies
/// share rows and statistics.
class LeastSquaresSystem {
 public:
  /// Reads all rows once (or twice, see above).
  /// @throws ArgumentError when names do not fit the columns; DataError when a row is not
  /// finite.
  LeastSquaresSystem(std::shared_ptr<const RowSource> rows, std::vector<std::string> term_names,
                     std::vector<std::string> target_names, const RunContext& context = {},
                     Folding folding = Folding::Automatic);

  Index rows() const noexcept { return factor_->rows; }                    ///< n
  Index terms() const noexcept { return factor_->terms(); }                ///< L
  Index targets() const noexcept { return factor_->target_norms.size(); }  ///< m
  const std::vector<std::string>& term_names() const noexcept { return *term_names_; }
  const std::vector<std::string>& target_names() const noexcept { return *target_names_; }

  /// rms of what each target has of systematic error (of the truncation of differences, say)
  /// over all rows, in its units; nothing when that is not known.
  const std::optional<Vector>& target_error() const noexcept { return target_error_; }

  /// The system with the systematic error of its targets.
  /// @throws ArgumentError unless there is one finite number >= 0 per target.
  LeastSquaresSystem with_target_error(Vector error) const;

  /// Statistics of all rows.
  const Factor& factor() const noexcept { return *factor_; }

  /// All term numbers 0..L-1.
  TermSet all_terms() const;

  /// The problem of one target in a subset of the terms.
  /// @throws ArgumentError when a number is out of range or the set is not increasing.
  Subproblem subproblem(Index target, TermSet active) const;

  /// The same problem with rows weighted by their residuals at h: minimises
  /// sum_i w_i (y_i - theta_i h)^2. One pass over the rows, folded as the system is.
  /// @param h one entry per active term, unscaled.
  /// @throws ArgumentError when h does not fit, or a weight is negative or not finite.
  Subproblem reweighted(const Subproblem& problem, const Vector& h,
                        const WeightFunction& weights, const RunContext& context = {}) const;

  /// Coefficients after one pass of iterative refinement: r = y - Theta h, R'R dh = Theta' r.
  /// Of very many rows that were folded orthogonally or deflated: as they are.
  /// @param problem not a weighted one.
  /// @throws ArgumentError when h does not fit.
  Vector refined(const Subproblem& problem, const Vector& h,
                 const RunContext& context = {}) const;

  /// Residuals y - Theta_A h of one target, all n of them. One pass.
  /// @throws ArgumentError when numbers are out of range or h does not fit.
  Vector residuals(Index target, const TermSet& active, const Vector& h,
                   const RunContext& context = {}) const;

 private:
  std::shared_ptr<const RowSource> source_;
  std::shared_ptr<const std::vector<std::string>> term_names_;
  std::shared_ptr<const std::vector<std::string>> target_names_;
  std::shared_ptr<const Factor> factor_;
  std::optional<Vector> target_error_ = {};
  Folding folding_;  // as asked for
};

}  // namespace lacuna
