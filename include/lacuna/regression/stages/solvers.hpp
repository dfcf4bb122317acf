// SPDX-License-Identifier: MIT
// Plug points that choose and fit terms: filter, regressor, pruner.
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {

/// Why a candidate term is not in the model: by whom, when, and by what number.
struct Removal {
  Index term = 0;          ///< number in the library
  std::string quantity;    ///< what was looked at: "smallest eigenvalue of E'E"
  double value = 0.0;      ///< what it was
  double threshold = 0.0;  ///< what it was compared with
  int step = 0;            ///< in which step of the stage, from 1
};

/// What a filter leaves.
struct FilterResult {
  TermSet kept;
  std::vector<Removal> removed;
};

/// Plug point: removes candidate terms that vanish on the data or that the others express,
/// without looking at any target.
class TermFilter : public StageInterface {
 public:
  static constexpr std::string_view kKind = "filter";

  /// @return kept and removed terms; together they are all terms. Columns of zeros are always
  ///   removed.
  FilterResult filter(const LeastSquaresSystem& system, const RunContext& context = {}) const;

 private:
  virtual FilterResult do_filter(const LeastSquaresSystem& system,
                                 const RunContext& context) const = 0;
};

/// How much a caller needs of a regression.
enum class Effort {
  Selection,  ///< good enough to compare terms; no pass over the rows only to refine
  Final,      ///< the coefficients that go into the model
};

/// Coefficients of one equation.
struct Regression {
  TermSet active;       ///< terms with a coefficient; a sparse method may have dropped some
  Vector coefficients;  ///< one per active term, in the units of the data
  double residual_norm = 0.0;  ///< |y - Theta_A h|, unweighted
  bool converged = true;
  int iterations = 0;
  std::vector<Removal> removed = {};  ///< terms a sparse method dropped, and by what number
};

/// Plug point: fits the coefficients of one target.
class Regressor : public StageInterface {
 public:
  static constexpr std::string_view kKind = "regressor";

  /// Fits the subproblem's target in its active terms. An empty set gives an empty regression
  /// with residual |y|.
  /// @param system the rows, for methods that need residuals.
  /// @param problem made from that system; may have had terms removed.
  Regression fit(const LeastSquaresSystem& system, const Subproblem& problem,
                 Effort effort = Effort::Final, const RunContext& context = {}) const;

 private:
  /// `problem` has at least one active term.
  virtual Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem,
                            Effort effort, const RunContext& context) const = 0;
};

/// min_z |c - R z|^2 + sum_j penalty_j |z_j| in triangular form; z are coefficients of columns
/// scaled to unit norm.
struct L1Problem {
  Matrix triangle;  ///< R, k x k upper triangular
  Vector target;    ///< c, k
  Vector penalty;   ///< k, >= 0
  Vector start;     ///< k, first guess
};

/// What an inner solver found.
struct L1Solution {
  Vector coefficients;
  int iterations = 0;
  bool converged = true;
};

/// Plug point: the inner solver of l1-regularised regression.
class L1Solver : public StageInterface {
 public:
  static constexpr std::string_view kKind = "l1-solver";

  /// Minimises the problem. @throws ArgumentError when shapes do not fit.
  L1Solution solve(const L1Problem& problem, const RunContext& context = {}) const;

 private:
  virtual L1Solution do_solve(const L1Problem& problem, const RunContext& context) const = 0;
};

/// What a pruner leaves.
struct PruneResult {
  TermSet kept;
  std::vector<Removal> removed;  ///< in the order of removal
};

/// Plug point: chooses the terms of one equation, refitting with the given regressor.
class TermPruner : public StageInterface {
 public:
  static constexpr std::string_view kKind = "pruner";

  /// Chooses among terms of one equation.
  /// @param active increasing numbers of the terms to choose from, below L: what a filter left.
  /// @return kept and removed terms; together they are `active`.
  PruneResult prune(const LeastSquaresSystem& system, Index target, const TermSet& active,
                    const Regressor& regressor, const RunContext& context = {}) const;

 private:
  virtual PruneResult do_prune(const LeastSquaresSystem& system, Index target,
                               const TermSet& active, const Regressor& regressor,
                               const RunContext& context) const = 0;
};

}  // namespace lacuna
