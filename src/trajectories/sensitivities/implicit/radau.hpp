// SPDX-License-Identifier: MIT
// The flow of a stiff model with its exact derivatives, by implicit steps.
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "trajectories/sensitivities/implicit/radau_system.hpp"
#include "trajectories/sensitivities/rates.hpp"

namespace lacuna {

/// Writes the slots of Rates behind the states for a time.
using DriveSlots = FunctionRef<void(double t, double* slots)>;

/// Errors of steps that are let pass.
struct PassedErrors {
  Vector accuracy;   ///< of each state, or empty: smaller ones are
  double tolerance;  ///< a smaller fraction of a state is
  Vector seen;       ///< the largest values of the states so far; a thousandth counts, too
};

/// Follows a model by steps that are as long as the error allows (estimated by an embedded
/// solution of order 3, IV.8 there), however short the fastest time of the model is. Values are
/// not for use from several threads at once.
class RadauFlow {
 public:
  /// @param accuracy of each state: errors of steps below are let pass; empty: none are.
  explicit RadauFlow(Vector accuracy = {}) : passed_{std::move(accuracy), kTolerance, {}} {}

  /// Steps whose error is a smaller fraction of a state are let pass by default.
  static constexpr double kTolerance = 1e-8;

  /// Another path begins: nothing of the last one is remembered.
  /// @param tolerance of its steps: errors below this fraction of a state, or of a thousandth
  ///   of its largest value, are let pass.
  void begin(double tolerance = kTolerance);

  /// So many systems of stages are solved from now on at most; then no step can be made.
  void allow(long solutions) { allowed_ = solutions; }
  long allowed() const { return allowed_; }  ///< how many more there may be

  /// Goes from t0 to t1, between which the signals are smooth.
  /// @param sensitivity nothing, or m x m, or m x (m + P): derivatives of the state by what
  ///   they are derivatives by, then by the parameters of the rates; carried on to t1.
  /// @return false where it cannot: x and the derivatives are not those of t1 then.
  bool advance(Rates& rates, DriveSlots drive, double t0, double t1, Vector& x,
               Matrix* sensitivity = nullptr);

  /// Makes one step of at most `longest`; parameters as of advance().
  /// @return its length; 0 where none can be made.
  double step(Rates& rates, DriveSlots drive, double t, double longest, Vector& x,
              Matrix* sensitivity = nullptr);

  /// How far the state was from the begin of the last step at its first (0) or second (1)
  /// stage.
  auto stage_shift(Index stage) const { return shift_.col(stage); }

 private:
  void linearise(Rates& rates, DriveSlots drive, double t, const Vector& x);
  bool is_rising_from_nothing(const Vector& x);
  void guess_sizes(Rates& rates, DriveSlots drive, double t, double h, const Vector& x);
  bool solve_stages(Rates& rates, DriveSlots drive, double t, double h, const Vector& x);
  double correct(Rates& rates, double h, const Vector& x);
  double error(Rates& rates, double h, const Vector& x);
  void vary(Rates& rates, double h, Matrix& sensitivity);

  PassedErrors passed_;
  double step_ = 0.0;                         // the next one; 0: not known yet
  long allowed_ = std::numeric_limits<long>::max();
  Matrix shift_;                              // m x 3: states of the stages less the begin
  // Of the present step; members, as models are small and memory would take most of its time.
  std::vector<double> begin_, slot_;          // slots at its begin, at a stage
  Vector rate_, scale_;
  Matrix slope_;                              // df/dx there
  Matrix slots_, stage_rates_;                // a row for each stage
  Matrix jacobian_, columns_;                 // entries of df/dx and df/dp there
  Matrix change_, weighted_;
  RadauSlopes slopes_;
  RadauSystem system_;
};

/// Whether Runge and Kutta's method of order 4 with steps of this length does not damp what
/// d' = J d damps: the bound of its stability on the negative axis.
bool is_beyond_explicit_steps(const Eigen::Ref<const Matrix>& jacobian, double step);

}  // namespace lacuna
