// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/dynamics/integration/simulate.hpp"

namespace lacuna::benchmarks {

/// How samples between the steps of a solver are made.
enum class Between {
  Quartic,  ///< the interpolant of order 4 that goes with the pair (Shampine 1986)
  Cubic,    ///< Hermite's cubic through states and rates at the steps
};

/// A model as most programs solve it: Dormand and Prince's 5(4) pair with steps of its own,
/// that do not know of the samples; those are read from an interpolant afterwards. The error of
/// one step, per state over absolute + relative |x|, has a root mean square below 1 (Hairer,
/// Norsett, Wanner, Sect. II.4).
/// @return n x m: the states at these times.
Matrix dense_solution(const DrivenModel& driven, const Vector& x0, const Vector& times,
                      double relative_tolerance, Between between);

}  // namespace lacuna::benchmarks
