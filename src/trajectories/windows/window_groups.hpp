// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "window_rows.hpp"

namespace lacuna {

/// Simulates and linearises the windows of a plan in groups, which several threads take in
/// turn. Groups depend on the plan alone, and so do results.
class WindowGroups {
 public:
  WindowGroups(const Rates& rates, std::shared_ptr<const StageSignals> signals, int threads);

  const StageSignals& signals() const noexcept { return *signals_; }

  /// From their initial states (windows x m), with these parameters.
  void simulate(const WindowPlan& plan, const Vector& parameters, const Matrix& starts,
                Orbits& orbits);

  /// R of the rows of each window (WindowRows::run()), in order.
  /// @param transitions receives Phi of every sampling interval: N x m^2.
  std::vector<Matrix> triangles(const WindowRowsInput& input, const Vector& parameters,
                                Matrix& transitions);

  /// As WindowRows::sensitivities().
  void sensitivities(const WindowRowsInput& input, const Vector& parameters,
                     FunctionRef<void(Index window, Index sample, const Matrix&)> visit);

 private:
  /// What simulates and linearises one group.
  struct Worker {
    Worker(const Rates& own, const StageSignals& signals);

    Rates rates;
    WindowSimulator simulator;
    WindowRows rows;
  };

  Worker& worker(std::size_t group, const Vector& parameters);
  void in_groups(const WindowPlan& plan, const Vector& parameters,
                 FunctionRef<void(Worker&, const WindowRange&)> work);

  const Rates& rates_;
  std::shared_ptr<const StageSignals> signals_;
  int threads_;
  std::vector<std::unique_ptr<Worker>> workers_;  // as many as plans have needed so far
};

}  // namespace lacuna
