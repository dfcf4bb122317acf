// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/stage.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/linear/subproblem.hpp"
#include "lacuna/regression/stages/removal.hpp"

namespace lacuna {

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

}  // namespace lacuna
