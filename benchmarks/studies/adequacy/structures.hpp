// SPDX-License-Identifier: MIT
// Right and wrong structures for one record each.
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna::benchmarks {

/// A record, the model that made it, and one that lacks something.
struct StructurePair {
  std::string name;
  std::string right, wrong;   ///< model files with the same outputs
  std::vector<double> start;  ///< of the right one
  double step = 0.25;
  Index samples = 40;
  double noise = 0.03;  ///< of the standard deviation of each output
};

/// Ten pairs, written down before the test of adequacy was made.
std::vector<StructurePair> structure_pairs();

}  // namespace lacuna::benchmarks
