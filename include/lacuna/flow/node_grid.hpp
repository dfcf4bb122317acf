// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/types.hpp"
#include "lacuna/model/program.hpp"
#include "lacuna/numerics/sampled_signal.hpp"

namespace lacuna {

/// Times of the nodes of a record: each sampling interval in `parts` equal parts.
/// @param time n samples. @return (n-1) parts + 1.
Vector node_times(const Vector& time, Index parts);

/// What was sampled, at the nodes, and t behind it: the slots of a program without delayed
/// variables. At samples they are the samples.
/// @param values n x q. @return ((n-1) parts + 1) x (q+1).
Matrix node_slots(const Vector& time, const Matrix& values, Index parts,
                  Interpolation interpolation = Interpolation::Cubic);

/// Delayed variables at the nodes, interpolated between samples; what lies before the record is
/// held at its first sample.
/// @param slots nodes x (q+1), as node_slots() has them. @return nodes x d.
Matrix delayed_slots(const Eigen::Ref<const Matrix>& slots, Index parts,
                     const std::vector<DelayedVariable>& delays,
                     Interpolation interpolation = Interpolation::Cubic);

}  // namespace lacuna
