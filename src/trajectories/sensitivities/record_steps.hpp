// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
// Integration of a model over the sampling steps of a record, each from its own begin.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lacuna/records/channels/node_grid.hpp"
#include "trajectories/sensitivities/rates.hpp"

namespace lacuna {

/// Slots at begins, middles and ends of the steps of a record; what drives the model goes on
/// between them as it is held, or as the line or the polynomial through the nearest samples.
struct StepSlots {
  Index states = 0, time = 0;  ///< number of states, column of t
  StepGrid grid;
  Matrix nodes;  ///< grid.rows(n) x (m+p+1+d)
  Matrix third;  ///< (n-1) x (p+1+d): third differences times the cube of the step, or 0

  /// @param slots as step_slots(), then columns of the delayed variables.
  StepSlots(Matrix slots, Index states, const std::vector<DelayedVariable>& delays,
            StepGrid grid = {});

  Index steps() const noexcept { return (nodes.rows() - 1) / grid.stride; }
  double length(Index step) const {
    return nodes(grid.end(step), time) - nodes(grid.begin(step), time);
  }

  /// Inputs, t or a delayed variable at a fraction of a step: the parabola through begin,
  /// middle and end, and what makes it the cubic through the nearest samples.
  /// @param weight of begin, middle and end; @param cubic s (s - 1/2) (s - 1) of the fraction
  /// s.
  double driven(Index step, Index column, const std::array<double, 3>& weight,
                double cubic) const {
    const double* value = nodes.col(column).data() + grid.begin(step);
    return weight[0] * value[0] + weight[1] * value[1] + weight[2] * value[2] +
           cubic * third(step, column - states);
  }
};

/// The most parts of all steps and of a single one; see parts_for() and refined_ends(). Facts
/// of cost: a jump is found to so much of a step, and few steps have one.
constexpr int kMostParts = 32, kMostPartsOfOne = 256;

/// States at the ends of steps.
/// @param steps numbers of the steps; @param parts steps of Runge and Kutta's method of order 4
///   in each. @return one row for each of `steps`.
Matrix ends_of_steps(Rates& rates, const StepSlots& slots, const std::vector<Index>& steps,
                     int parts);

/// The same where the rates at the begins are known.
/// @param begin_rates one row for each of `steps`.
Matrix ends_of_steps(const Rates& rates, const StepSlots& slots,
                     const std::vector<Index>& steps, const Matrix& begin_rates, int parts);

/// Parts of a step, and what was tried to find them.
struct FoundParts {
  std::vector<int> parts;    ///< for each of the accuracies
  std::vector<Index> tried;  ///< steps, in their order
  Matrix ends;               ///< of these with the first of `parts`
  /// Whether a few of the steps need more than the first of `parts`: rates jump there.
  bool some_need_more = false;
};

/// Parts of a step that leave an error of less than a tenth of each of several accuracies (an
/// entry for each state), powers of two up to 32; a sample of the steps decides. For the first
/// accuracy it may be more in a tenth of the steps, which refined_ends() then does in more
/// parts.
FoundParts parts_for(Rates& rates, const StepSlots& slots,
                     const std::vector<Vector>& accuracies);

/// The ends of steps, those that need more parts in twice as many again and again, up to
/// kMostPartsOfOne: steps in which a rate jumps come nearer by as much as these get shorter.
/// @param ends of all steps in `parts`. @param begin_rates one row for each step.
/// @param accuracy an entry for each state, of which a tenth is enough.
/// @return ends of all steps; nothing where one is not finite however many parts it has.
std::optional<Matrix> refined_ends(const Rates& rates, const StepSlots& slots, Matrix ends,
                                   const Matrix& begin_rates, int parts,
                                   const Vector& accuracy);

/// Number of states, and of parts in which a step is done.
struct StepSize {
  Index states = 0;
  int parts = 1;
};

/// Transition matrices (m^2 x steps) and responses (3 m^2 x steps) of linear systems.
struct StepResponses {
  Matrix transition, response;
};

/// Of d' = A(t) d + rate, with A a parabola in each step: transition by Runge and Kutta's
/// method of order 4, responses to rates that are 1, at begin, middle or end, and a parabola
/// between them by Simpson's rule.
/// @param slopes m^2 x grid.rows(n): A at begins, middles and ends. @param length n-1 entries.
/// @param size number of states, and of parts in which a step is done.
/// @return responses w0, w1, w2 (m each) to a rate of state 0, then of 1, ...
StepResponses step_responses(const Matrix& slopes, const StepGrid& grid, const Vector& length,
                             const StepSize& size);

}  // namespace lacuna
