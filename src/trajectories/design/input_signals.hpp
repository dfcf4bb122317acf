// SPDX-License-Identifier: MIT
// Designs as points of a unit cube, and the signals that they stand for.
#pragma once

#include <vector>

#include "lacuna/trajectories/design/plan.hpp"

namespace lacuna {

/// Numbers in [0,1] that a signal of an input has.
Index design_size(const PlanInput& input, InputFamily family);

/// The signal at times (rising, from 0 on): in the input's range, no faster than its rate, and
/// changed every `hold` only. Between two changes it is held.
/// @param design design_size() numbers in [0,1]; @param step where the input has no hold.
Vector input_signal(const PlanInput& input, InputFamily family,
                    const Eigen::Ref<const Vector>& design, const Vector& time, double step);

/// How all inputs of a design are made.
struct DesignSpace {
  std::vector<InputFamily> families;  ///< one for each input
};

/// Spaces to be searched: the k-th has the k-th family of each input, begun again where an
/// input has fewer.
std::vector<DesignSpace> design_spaces(const PlanProblem& problem);

/// Numbers in [0,1] of a design: inputs, then settable starts, then times of measurement.
Index design_size(const PlanProblem& problem, const DesignSpace& space);

/// The experiment that a point of the cube stands for.
Experiment experiment_of(const PlanProblem& problem, const DesignSpace& space,
                         const Vector& design);

}  // namespace lacuna
