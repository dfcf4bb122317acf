// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/core/numerics/sampled_signal.hpp"
#include "lacuna/model/expressions/program.hpp"

namespace lacuna {

/// Times of the nodes of a record: each sampling interval in `parts` equal parts.
/// @param time n samples. @return (n-1) parts + 1.
/// @throws ArgumentError when there are no samples or no parts.
Vector node_times(const Vector& time, Index parts);

/// What was sampled, at the nodes, and t behind it: the slots of a program without delayed
/// variables. At samples they are the samples.
/// @param values n x q. @return ((n-1) parts + 1) x (q+1).
Matrix node_slots(const Vector& time, const Matrix& values, Index parts,
                  Interpolation interpolation = Interpolation::Cubic);

/// Delayed variables at the nodes, by the cubic between samples; what lies before the record is
/// held at its first sample.
/// @param slots nodes x (q+1), as node_slots() has them. @return nodes x d.
Matrix delayed_slots(const Eigen::Ref<const Matrix>& slots, Index parts,
                     const std::vector<DelayedVariable>& delays);

/// Where the begins, middles and ends of the sampling steps of a record stand among its nodes.
/// Where all signals are continuous the end of a step is the begin of the next one (stride 2);
/// where one jumps at samples each step has an end of its own (stride 3).
struct StepGrid {
  Index stride = 2;
  std::vector<Interpolation> signals = {};  ///< of each column; empty: cubic, all of them

  Index begin(Index step) const noexcept { return stride * step; }       ///< of a step: its row
  Index middle(Index step) const noexcept { return stride * step + 1; }  ///< of a step: its row
  Index end(Index step) const noexcept { return stride * step + 2; }     ///< of a step: its row
  Index rows(Index samples) const noexcept { return stride * (samples - 1) + 1; }  ///< of all
  /// How a column goes on between its samples.
  Interpolation signal(Index column) const {
    return signals.empty() ? Interpolation::Cubic : signals[static_cast<std::size_t>(column)];
  }
  /// Whether a column jumps at its samples.
  bool is_held(Index column) const { return signal(column) == Interpolation::Held; }
};

/// The grid of columns that go on so between their samples.
StepGrid step_grid(std::vector<Interpolation> signals);

/// What was sampled at begins, middles and ends of steps, and t behind it. At the end of a step
/// a held signal has the value that it had all along.
/// @param values n x q. @return grid.rows(n) x (q+1).
/// @throws ArgumentError when shapes do not fit or the times do not increase.
Matrix step_slots(const Vector& time, const Matrix& values, const StepGrid& grid);

/// Delayed variables at begins, middles and ends of steps. Of a held signal, which jumps
/// inside of steps then, each step has the parabola of least squares where all is affine in it
/// (SampledSignal::held_moments()), else the line (SampledSignal::held_line()).
/// @param slots as step_slots() has them. @return rows x d.
Matrix delayed_step_slots(const Eigen::Ref<const Matrix>& slots, const StepGrid& grid,
                          const std::vector<DelayedVariable>& delays);

}  // namespace lacuna
