// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hidden/support/hidden_case.hpp"
#include "hidden/support/records.hpp"

namespace lacuna::hidden {

/// Of the measurement noise, relative to the states, where no lattice takes its place.
inline constexpr double kBenchNoise = 0.005;

/// A case with its records.
struct BenchCase {
  HiddenCase hidden;
  Records records = {};
  Records clean = {};                        ///< the same without noise
  std::vector<std::string> forbidden = {};  ///< names that no answer may have
};

}  // namespace lacuna::hidden
