// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Weights lambda of penalties on the m-th derivative among which one is chosen.
struct PenaltyRange {
  double least, largest;  ///< time^(2m-1)
};

/// 1e-6 to 1e11 in units of h^(2m-1): from interpolation to where rounding of the normal
/// equations decides. @param step mean step h > 0.
PenaltyRange penalty_range(double step, int order);

/// Samples at an end that smoothing sees from one side: twice lambda^(1/2m) / h^(1 - 1/2m), the
/// length over which the equivalent kernel falls by a factor e (Silverman, Ann. Stat. 12 (1984)
/// 898-916).
Index penalty_margin(double lambda, double step, int order);

}  // namespace lacuna
