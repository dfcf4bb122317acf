// SPDX-License-Identifier: MIT
// What a model predicts in windows of a record.
#pragma once

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// Samples that are predicted.
struct PredictedRecord {
  Trajectory samples;
  Matrix deviations;  ///< n x m: noise of each sample; 0: it is not measured or does not count
  Matrix path;        ///< n x m: states near the truth, those that were not measured too
};

/// Residuals of windows.
struct WindowResiduals {
  Vector squares;   ///< m: sum of r^2
  Vector freedom;   ///< m: sum of 1 - leverage
  Vector expected;  ///< m: the squares that deviations make: sum of deviation^2 (1 - leverage)
  Vector neighbours;  ///< m: sum of r_i r_(i+1) within windows
  Index windows = 0;
  Index lost = 0;       ///< windows without a finite solution
  Index unstarted = 0;  ///< windows with one, in which none was found that fits

  explicit WindowResiduals(Index states)
      : squares(Vector::Zero(states)),
        freedom(squares),
        expected(squares),
        neighbours(squares) {}
  void add(const WindowResiduals& other);
};

/// Residuals y - x in windows of a record one behind the other, x being the solution of the
/// model from the initial state for which sum ((y - x) / deviation)^2 is least. The problem is
/// linearised about the path and about its own solutions, `passes` times in all. With D_i the
/// derivative of x_i with respect to the initial state, the leverage of a sample is its
/// diagonal entry of D (D'D)^-1 D' (rows over their deviations).
/// Where that problem has no finite solution the model is run from the path's first state in
/// the window: where this run is finite the next pass begins at it, and after the last pass the
/// window counts as `unstarted`; else the model has no solution there, and the window is
/// `lost`.
/// @param length samples of a window, at least 2; the rest behind the last is not used.
WindowResiduals predict(const OdeModel& model, const PredictedRecord& record, Index length,
                        int passes);

}  // namespace lacuna
