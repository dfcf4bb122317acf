// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/system_model.hpp"
#include "trajectories/shooting/residual_statistics.hpp"
#include "trajectories/windows/windows.hpp"

namespace lacuna {

/// How a model is fitted to trajectories.
struct RefineOptions {
  /// Noise of each measured state (units of the state, in the order of the model's states that
  /// have a column). Without it: estimated from the residuals of the fit.
  std::optional<Vector> sigma = {};

  /// Residuals beyond so many sigma count linearly (Huber 1964; 1.345 keeps 95 % efficiency).
  std::optional<double> huber = {};

  /// Starting states at all samples (N x m, trajectories one behind the other). Without it:
  /// the record, and equations that define what was not measured.
  std::optional<Matrix> states = {};

  /// Samples of each window; without it windows are matched to the growth of errors.
  std::optional<Index> window_samples = {};

  int max_iterations = 50;  ///< of each plan of windows

  /// White noise of each column of the record (estimate_noise()), where it is known already.
  std::optional<Vector> noise = {};

  bool may_be_cut = false;  ///< past the deadline: the fit in the windows that it has by then
};

/// How a refinement ended.
enum class RefineStatus {
  Converged,
  IterationLimit,  ///< the numbers are those of the last iteration
  Diverged,        ///< no windows were found in which the model can be simulated
};

/// "converged", "iteration limit", "diverged".
std::string to_string(RefineStatus status);

/// A model fitted to trajectories.
struct Refinement {
  ParametrisedModel model;  ///< at the estimated values
  RefineStatus status = RefineStatus::Converged;
  std::string message = {};  ///< one sentence when not converged, else empty
  int iterations = 0;        ///< of all plans together
  bool in_time = true;       ///< whether no deadline came before the longest windows

  /// P; from the Fisher information where residuals are white, else from blocks of the record
  /// (residuals of a model that is not exact are correlated over time); infinite where the
  /// record does not determine a parameter.
  Vector standard_errors = {};
  Matrix ci95 = {};        ///< P x 2: low and high end of the 95 % interval
  Matrix covariance = {};  ///< P x P

  /// P, Cramer-Rao bound on the standard deviation of any unbiased estimate from these windows
  /// with Gaussian noise of the stated sigma: sqrt of the diagonal of the inverse Fisher
  /// information, initial states being unknown.
  Vector bound = {};

  std::vector<Index> measured = {};  ///< states of the model that have a column
  Vector sigma = {};                 ///< noise of each of them
  WindowPlan windows = {};
  Matrix states = {};            ///< simulated states at all samples, N x m
  double chi_squared = 0.0;      ///< sum of (r / sigma)^2
  Index degrees_of_freedom = 0;  ///< residuals less parameters and initial states

  std::vector<ResidualStatistics> residuals = {};  ///< of each measured state
  bool white = false;                              ///< whether no residual has structure left
  bool fits_to_noise = false;                      ///< whether all of them are noise

  /// The plain model with standard errors and intervals on its coefficients.
  OdeModel fitted() const;
};

/// Fits the free parameters of a model to measured trajectories by multiple shooting.
///
/// Minimises sum_n,k ((y_k(t_n) - x_k(t_n)) / sigma_k)^2 + sum_j ((p_j - prior_j) /
/// tolerance_j)^2 over the parameters and the initial states of all windows, x being the
/// solution of the model in each window (Bock 1983). Derivatives are those of the integrator's
/// steps themselves, from the symbolic Jacobian (variational equations); initial states are
/// eliminated window by window by QR, so that the iteration of Levenberg and Marquardt works on
/// P parameters only. Windows begin short (errors grow threefold, or the states turn once) and
/// are doubled as long as errors do not grow beyond what the noise allows and the parameters
/// become better known by it. Noise enters the residuals as it was measured: there is no bias
/// from noise in the regressors.
///
/// Integration steps are made so fine that their error shifts no parameter by more than a tenth
/// of its standard error. States without a column are allowed. Trajectories of one file whose
/// time goes on after at most ten steps are one record with missing samples; windows go across.
/// Same input, same result.
/// @throws DataError as the record must have the model's inputs and at least one of its states,
///   and every other state must follow from an equation; ArgumentError for options of a wrong
///   size; Cancelled; OutOfTime past the deadline, where the fit may not be cut.
/// Errors are not finite where the record does not determine a number.
Refinement refine(const ParametrisedModel& model, const Dataset& record,
                  const RefineOptions& options = {}, const RunContext& context = {});

}  // namespace lacuna
