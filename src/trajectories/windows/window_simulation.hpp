// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "shooting_record.hpp"
#include "trajectories/windows/windows.hpp"

namespace lacuna {

/// Simulated states of all windows.
struct Orbits {
  std::vector<Matrix> stages;   ///< per stage: states where f was evaluated, steps x m
  Matrix samples;               ///< N x m
  std::vector<Index> diverged;  ///< windows whose states are not finite
};

/// Windows [first, first + count) of a plan.
struct WindowRange {
  Index first = 0, count = 0;
};

/// Room for the states of all windows.
/// @param samples of the record.
void make_room(const StageSignals& signals, Index dimension, Index samples, Orbits& orbits);

/// Numbers of the windows of a plan whose states are not finite.
std::vector<Index> diverged_windows(const WindowPlan& plan, const Orbits& orbits);

/// Simulates windows side by side: a step is made in all of them at once, so that the model is
/// evaluated for blocks of windows; the last few are finished one by one.
class WindowSimulator {
 public:
  WindowSimulator(const StageSignals& signals, Index dimension);

  /// Simulates some windows of a plan.
  /// @param starts initial states, windows of the plan x m.
  /// @param orbits with room for them (make_room()); only what belongs to these windows is
  ///   written.
  void run(Rates& rates, const WindowPlan& plan, const WindowRange& range, const Matrix& starts,
           Orbits& orbits);

 private:
  void prepare(const Rates& rates, Index windows);
  void step_block(Rates& rates, Index active, Index step, Orbits& orbits);
  void finish(Rates& rates, const Window& window, Index lane, Index step, Orbits& orbits);
  void note_sample(const Window& window, Index lane, Index step, Orbits& orbits) const;
  void find_steps(Index active, Index step);
  void gather(const Matrix& signals, Index active);
  void scatter(Matrix& states, Index active) const;
  void move(Index stage, Index active);
  const Window& lane_window(Index lane) const {
    return (*plan_)[static_cast<std::size_t>(order_[static_cast<std::size_t>(lane)])];
  }
  Index substeps() const noexcept { return signals_.scheme.substeps; }

  const StageSignals& signals_;
  Index dimension_;
  const WindowPlan* plan_ = nullptr;  // of the present run
  std::vector<Index> order_;          // windows by falling length
  Matrix states_;                     // lanes x m
  Matrix point_;                      // slots of a block
  Matrix gathered_;                   // signals of a block
  std::vector<Matrix> slopes_;        // per stage: step length times f, lanes x m
  std::vector<Index> steps_;          // next step of each lane
  Vector lengths_;
  std::vector<double> slot_, slope_;
};

}  // namespace lacuna
