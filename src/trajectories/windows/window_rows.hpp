// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/types.hpp"
#include "regression/linear/row_fold.hpp"
#include "trajectories/sensitivities/step_maps.hpp"
#include "window_simulation.hpp"

namespace lacuna {

/// What the rows of the windows are made of: whitened residuals and their derivatives.
struct WindowRowsInput {
  const ShootingRecord& record;
  const StageSignals& signals;
  const WindowPlan& plan;
  const Orbits& orbits;
  const Matrix& weights;  ///< N x measured: 1 / sigma, times the square root of robust weights
};

/// The linearised problem of each window in turn. For every sample and measured state a row
///   [ S_a  S_p | r ],  S_a = dx/da, S_p = dx/dp, r = y - x, all times weight,
/// with S from the recursion S_{n+1} = Phi_n S_n + [0 Gamma_n], S_0 = [1 0].
class WindowRows {
 public:
  WindowRows(Rates& rates, const StepScheme& scheme);

  /// Columns of a window's triangle: m initial states, the columns of df/dp, the residual.
  Index columns() const noexcept { return dimension_ + columns_ + 1; }

  /// Calls `visit(window, triangle)` with R of the rows of each window of a range, in order.
  /// @param transitions receives Phi of every sampling interval of theirs: N x m^2.
  void run(const WindowRowsInput& input, const WindowRange& range,
           FunctionRef<void(Index, const Matrix&)> visit, Matrix& transitions);

  /// Calls `visit(sample, S)` with the m x (m + columns) sensitivities of each sample.
  void sensitivities(const WindowRowsInput& input,
                     FunctionRef<void(Index window, Index sample, const Matrix&)> visit);

 private:
  void follow(const WindowRowsInput& input, Index window,
              FunctionRef<void(Index window, Index sample, const Matrix&)> visit,
              Matrix* transitions);
  void pass_step(Index block_row);
  void note_transition(Index interval, Matrix& transitions) const;

  Rates& rates_;
  Index substeps_, dimension_, columns_;
  StepMaps maps_;
  Matrix sensitivity_;  // m x (m + columns)
  Matrix transition_;   // Phi of one step, m x m
  Matrix interval_;     // product over an interval
  Vector column_;       // scratch
  RowFold fold_;
};

}  // namespace lacuna
