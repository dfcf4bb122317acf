// SPDX-License-Identifier: MIT
// Integration of a model over the sampling steps of a record, each from its own begin.
#pragma once

#include <array>
#include <vector>

#include "rate_table.hpp"

namespace lacuna {

/// The parabolas through 0, 1/2, 1 that are 1 at one of them.
inline std::array<double, 3> parabolas(double s) {
  return {(1.0 - s) * (1.0 - 2.0 * s), 4.0 * s * (1.0 - s), s * (2.0 * s - 1.0)};
}

/// States at the ends of steps.
/// @param slots (2n-1) x (m+p+1+d): begins, middles and ends of the steps; inputs and delayed
///   variables are cubics through the nearest samples.
/// @param steps numbers of the steps; @param parts steps of Runge and Kutta's method of order 4
///   in each. @return one row for each of `steps`.
Matrix ends_of_steps(const RateTable& table, const Matrix& slots, Index states,
                     const std::vector<Index>& steps, int parts);

/// Parts of a step that leave an error of less than a tenth of the accuracy, a power of two up
/// to 32; a sample of the steps tells.
int parts_for(const RateTable& table, const Matrix& slots, Index states,
              const Vector& accuracy);

/// Transition matrices (m^2 x steps) and responses (3 m^2 x steps) of linear systems.
struct StepResponses {
  Matrix transition, response;
};

/// Of d' = A(t) d + rate, with A a parabola in each step.
/// @param slopes m^2 x (2n-1): A at begins, middles and ends. @param length n-1 entries.
StepResponses step_responses(const Matrix& slopes, const Vector& length, Index states,
                             int parts);

}  // namespace lacuna
