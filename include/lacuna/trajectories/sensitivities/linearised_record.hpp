// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <span>

#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/records/channels/node_grid.hpp"

namespace lacuna {

/// A model linearised along a path through a record, one sampling step at a time.
///
/// With the path x_i (near to the truth), deviations d_i = truth - x_i and an extra rate g(t)
/// in equation k with the coefficient c,
///
///   d_{i+1} = Phi_i d_i + b_i + c (w0 g(t_i) + w1 g(t_i + h/2) + w2 g(t_{i+1})),
///
/// where Phi_i is the transition matrix of the step, b_i = F(x_i) - x_{i+1} what the model
/// predicts beyond the path, and w0, w1, w2 its response to a rate that is a parabola in the
/// step.
struct LinearisedRecord {
  Vector time;        ///< n
  Matrix path;        ///< n x m
  Matrix slots;       ///< R x (m+p+1): variables and t at begins, middles and ends of steps
  Matrix transition;  ///< m^2 x (n-1): Phi_i, column by column
  Matrix response;    ///< 3 m^2 x (n-1): w0, w1, w2 (m each) of equation 0, then of 1, ...
  Matrix defect;      ///< m x (n-1): b_i
  /// m x (n-1), or empty: spectral density that the disturbance of an equation has at least in
  /// each step. It is above 0 where an equation has a term that cannot be known (a delayed one
  /// that needs what was before the record, an input that jumps at an unknown instant); such a
  /// step determines nothing of the noise model.
  Matrix bridge = {};
  StepGrid grid = {};  ///< where these are: R = grid.rows(n), 2n-1 unless an input jumps
  Vector range = {};   ///< m: of the path, or of the whole path that this is a part of

  Index samples() const noexcept { return time.size(); }      ///< n
  Index states() const noexcept { return path.cols(); }       ///< m
  Index steps() const noexcept { return transition.cols(); }  ///< n - 1
  /// The n rows of `slots` that are samples.
  auto sample_rows() const { return Eigen::seq(0, slots.rows() - 1, grid.stride); }
  /// Whether an equation is bridged in a step.
  bool is_bridged(Index step, Index equation) const {
    return bridge.size() > 0 && bridge(equation, step) > 0.0;
  }
};

/// Linearises a model along a path.
/// @param record times and inputs; @param path n x m, replaces the record's states.
/// The derivatives of the rates are slopes over the reach of a part of a step or over the
/// accuracy, so that a jump (dry friction, a stop) acts on a deviation as it does on average.
/// @param accuracy m entries: an error of a step that is small against them is good enough; the
///   steps of the integration (Runge-Kutta of order 4) are halved until it is.
/// @throws ArgumentError when shapes do not fit or the record has fewer than four samples.
LinearisedRecord linearise(const OdeModel& model, const Trajectory& record, const Matrix& path,
                           const Vector& accuracy);

/// Samples [first, first + count) of a linearised record.
/// @throws ArgumentError when they are not there or none.
LinearisedRecord part_of(const LinearisedRecord& record, Index first, Index count);

/// Only the grid of a record along a path (n x m): time, path and slots.
/// @param inputs of the record, which say how they go on between samples.
LinearisedRecord grid_of(const std::vector<Quantity>& inputs, const Trajectory& record,
                         const Matrix& path);

/// Values of delayed variables on the grid of `slots`, which holds the variables in its first
/// columns; what lies before the record is held at its first sample (delayed_step_slots()).
/// @return R x (m+p+1+d): `slots` and one column for each delayed variable.
/// @throws ArgumentError when there is no such variable.
Matrix with_delays(const LinearisedRecord& record, const std::vector<DelayedVariable>& delays);

/// Values of formulas at begins, middles and ends of steps, R x count.
/// @throws ModelError when one uses a name that is not a variable of the model.
/// Not finite where a formula is not.
Matrix evaluate_on(const LinearisedRecord& record, const Variables& variables,
                   std::span<const Expression> formulas);

/// Values of one formula at begins, middles and ends of steps, R entries.
Vector evaluate_on(const LinearisedRecord& record, const Variables& variables,
                   const Expression& formula);

}  // namespace lacuna
