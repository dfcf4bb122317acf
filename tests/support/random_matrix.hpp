// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/base/random.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna::testing {

/// Independent standard normal entries, one column after the other.
inline Matrix random_matrix(Random& random, Index rows, Index columns) {
  Matrix a(rows, columns);
  for (double& entry : a.reshaped()) entry = random.normal();
  return a;
}

/// Those of a seed.
inline Matrix random_matrix(Index rows, Index columns, std::uint64_t seed) {
  Random random(seed);
  return random_matrix(random, rows, columns);
}

}  // namespace lacuna::testing
