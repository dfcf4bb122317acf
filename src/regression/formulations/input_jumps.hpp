// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/expressions/program.hpp"

namespace lacuna {

/// Where held inputs jump. At such a sample the right-hand side has two limits, and what a
/// difference quotient or an integral across the sample shows is their mean.
struct InputJumps {
  std::vector<Index> rows;  ///< ascending
  Matrix before;            ///< of each, the variables with the held inputs of the sample before
};

/// The jumps at samples first, first + 1, ..., one for each row.
/// @param slots values of the variables there, states, inputs, time and what follows.
/// @param held inputs, by number.
InputJumps input_jumps(const Trajectory& record, Index first,
                       const Eigen::Ref<const Matrix>& slots, const std::vector<Index>& held);

/// Terms at the jumps among rows begin, begin + 1, ... become the mean of both limits.
/// @param theta their values behind the jumps, one row each from `begin` on.
void average_at(const InputJumps& jumps, const Program& program, Index begin,
                Eigen::Ref<Matrix> theta, Program::Workspace& workspace);

}  // namespace lacuna
