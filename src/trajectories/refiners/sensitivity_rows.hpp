// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "trajectories/sensitivities/linear_step.hpp"
#include "window_rates.hpp"

namespace lacuna {

/// A coefficient: of which term in which equation.
struct Coefficient {
  Index equation = 0;
  Index term = 0;
  auto operator<=>(const Coefficient&) const = default;
};

/// Columns of one equation.
struct ColumnBlock {
  Index equation = 0, first = 0;  ///< first: its place among [S G c]
  std::vector<Index> terms;       ///< rows of Theta
  bool contiguous = false;
};

/// Columns of equations, which follow each other, by blocks.
/// @param terms rows of Theta: all terms of the columns, increasing.
std::vector<ColumnBlock> column_blocks(const std::vector<Coefficient>& columns,
                                       const std::vector<Index>& terms, Index dimension);

/// The rows [S G | y - c] / sigma of one window, with the memory to integrate them in.
struct SensitivityRows {
  Matrix rows;     ///< (m + q + 1) x samples m, one in each column
  Index used = 0;  ///< how many there are
  LinearStep step;
  Matrix now, next;  ///< (m + q + 1) x m: [S G c]' at a node and at the next but one
};

/// Integrates [S G c] over a window.
/// @param rates evaluated in this window.
void integrate_rows(const WindowRates& rates, const std::vector<ColumnBlock>& blocks,
                    const PathRecord& record, const SampleWindow& window,
                    SensitivityRows& result);

}  // namespace lacuna
