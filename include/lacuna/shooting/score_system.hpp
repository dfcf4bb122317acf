// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/linear/subproblem.hpp"
#include "lacuna/shooting/refine.hpp"

namespace lacuna {

/// A term that might be in an equation.
struct CandidateTerm {
  Index equation = 0;
  Term term;
};

/// What one candidate would do for a refined model, all its parameters being refitted.
struct CandidateScore {
  double coefficient = 0.0;     ///< that it would get
  double standard_error = 0.0;  ///< infinite when the record does not determine it
  double gain = 0.0;            ///< decrease of chi squared; (coefficient / standard_error)^2
};

/// The multiple-shooting problem linearised at a refined model, with further terms as columns.
///
/// A candidate g in equation k moves the simulated states by
///   D_{n+1} = Phi_n D_n + sum_a Lambda_a,n e_k g(X_a,n),  D = 0 at the begin of a window,
/// with Phi_n and Lambda_a,n of the steps as simulated, so that a column costs O(n m^2) and
/// nothing is integrated again. Rows are measured states over sigma at the samples; initial
/// states of all windows are projected out. As rows are compared with the samples themselves
/// and columns come from simulated states, residuals of a right model are white and there is no
/// bias from noise in the columns.
///
/// Columns are the P parameters of the model, then the candidates. Targets of the factor are
/// the residuals (solutions are changes of the parameters, and coefficients of candidates), and
/// the residuals plus what the parameters explain (solutions are the parameters themselves).
class ScoreSystem {
 public:
  static constexpr Index kChange = 0;    ///< target whose solutions are changes
  static constexpr Index kAbsolute = 1;  ///< target whose solutions are values

  /// @param model a refined model; @param record the one it was refined with; @param options
  ///   as then.
  /// @throws ArgumentError when a candidate is in an equation that does not exist or is already
  /// a
  ///   free term of it; as refine().
  ScoreSystem(const Refinement& model, const Dataset& record,
              const std::vector<CandidateTerm>& candidates, const RefineOptions& options = {});

  /// "y: x*z", parameters first.
  const std::vector<std::string>& names() const noexcept { return names_; }

  Index parameters() const noexcept { return parameters_; }  ///< P
  Index candidates() const noexcept { return factor_.terms() - parameters_; }

  /// R of the whitened rows with initial states projected out; rows() is the number of
  /// residuals less initial states.
  const Factor& factor() const noexcept { return factor_; }

  /// The problem of some of the columns, for elimination by Givens rotations.
  Subproblem subproblem(Index target, TermSet active) const {
    return {factor_, target, std::move(active)};
  }

  /// Each candidate on its own beside all parameters, in the order given.
  std::vector<CandidateScore> scores() const;

 private:
  std::vector<std::string> names_;
  Index parameters_ = 0;
  Factor factor_;
};

/// Every term of the library in every equation that is not marked exact, less what is a free
/// term there already.
/// @param exact one entry per equation, or empty.
std::vector<CandidateTerm> candidates_from(const TermLibrary& library,
                                           const ParametrisedModel& model,
                                           const std::vector<bool>& exact = {});

}  // namespace lacuna
