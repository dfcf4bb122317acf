// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/types.hpp"

namespace lacuna {

/// Values between samples by the cubic through the four samples nearest to each query (fewer
/// where the record is shorter); the error falls as step^4.
/// @param time n >= 1, strictly increasing; @param values n; @param queries inside the record.
Vector interpolate_cubic(const Vector& time, const Vector& values, const Vector& queries);

/// Integral from the first sample to each sample of the same piecewise cubic, 0 at the first:
/// exact for cubics, else the error falls as step^4.
/// @param time n >= 1, strictly increasing; @param values n.
Vector integrate_cubic(const Vector& time, const Vector& values);

}  // namespace lacuna
