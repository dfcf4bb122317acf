// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "trajectories/windows/window_groups.hpp"

namespace lacuna {

/// Parameters, initial states of the windows, and what they give.
struct ShootingPoint {
  Vector parameters;    ///< P
  Matrix starts;        ///< windows x m
  Orbits orbits = {};   ///< simulated from them
  double cost = 0.0;    ///< sum of rho(r / sigma) and priors; twice the negative log-likelihood
  bool finite = false;  ///< whether no window diverged
};

/// The problem linearised at a point, window by window.
struct ShootingLinearisation {
  std::vector<Matrix> windows;  ///< R of [S_a S_p | r]
  Matrix reduced;               ///< R of all windows and priors without initial states, P + 1
  Matrix transitions;           ///< Phi of every sampling interval, N x m^2
};

/// A step and the decrease of cost that the linear problem promises.
struct ShootingStep {
  Vector parameters;
  Matrix starts;
  double decrease = 0.0;
};

/// The residuals of a model against a record, for any windows; the engine of the refinement.
class ShootingProblem {
 public:
  /// @param huber residuals beyond so many sigma count linearly; nothing: least squares.
  /// @param threads that work on groups of windows; results do not depend on it.
  ShootingProblem(const ParametrisedModel& model, const Dataset& data,
                  std::optional<double> huber, int threads = 1);

  const ShootingRecord& record() const noexcept { return record_; }
  Rates& rates() noexcept { return rates_; }
  const ParametrisedModel& model() const noexcept { return model_; }
  const StageSignals& signals() const noexcept { return windows_->signals(); }

  void set_scheme(const StepScheme& scheme);
  const StepScheme& scheme() const noexcept { return signals().scheme; }

  void set_sigma(Vector sigma) { sigma_ = std::move(sigma); }
  const Vector& sigma() const noexcept { return sigma_; }  ///< of each measured state

  /// Simulates all windows and sums up.
  void evaluate(const WindowPlan& plan, ShootingPoint& point);

  /// Whitened residuals r / sigma, N x measured; samples of no window are zero.
  Matrix residuals(const WindowPlan& plan, const ShootingPoint& point) const;

  /// 1 / sigma times the square root of the robust weight of each residual.
  Matrix row_weights(const ShootingPoint& point) const;

  ShootingLinearisation linearise(const WindowPlan& plan, const ShootingPoint& point);

  /// Calls `visit(window, sample, S)` with the m x (m + P) sensitivities at each sample.
  void sensitivities(const WindowPlan& plan, const ShootingPoint& point,
                     FunctionRef<void(Index, Index, const Matrix&)> visit);

  /// The step of Levenberg and Marquardt: minimises the linear problem plus
  /// damping^2 |D step|^2, D the norms of the columns.
  ShootingStep solve(const ShootingLinearisation& linear, const ShootingPoint& point,
                     double damping) const;

 private:
  std::shared_ptr<const StageSignals> signals_of(const StepScheme& scheme);
  double loss(double residual) const;
  void add_priors(const Vector& parameters, RowFold& fold) const;

  ParametrisedModel model_;
  ShootingRecord record_;
  Rates rates_;
  std::optional<double> huber_;
  std::vector<std::optional<Prior>> priors_;
  Vector sigma_;
  std::vector<std::shared_ptr<const StageSignals>> known_signals_;  // of schemes used before
  std::unique_ptr<WindowGroups> windows_;                           // of the present scheme
  int threads_;
};

/// Solution of an upper triangular system in which directions with a pivot below rounding get
/// 0.
Vector solve_determined(const Eigen::Ref<const Matrix>& triangle,
                        const Eigen::Ref<const Vector>& target);

/// Diagonal-scaled inverse of R'R; infinite variance where the rows do not determine a
/// parameter.
Matrix covariance_of(const Eigen::Ref<const Matrix>& triangle);

}  // namespace lacuna
