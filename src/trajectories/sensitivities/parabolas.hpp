// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace lacuna {

/// The parabolas through 0, 1/2, 1 that are 1 at one of them.
inline std::array<double, 3> parabolas(double s) {
  return {(1.0 - s) * (1.0 - 2.0 * s), 4.0 * s * (1.0 - s), s * (2.0 * s - 1.0)};
}

}  // namespace lacuna
