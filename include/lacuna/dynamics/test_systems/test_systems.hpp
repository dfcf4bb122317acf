// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// A known system to try methods on.
struct TestSystem {
  std::string name;       ///< "rossler", "lorenz", ...
  std::string summary;    ///< one sentence
  std::string reference;  ///< where equations and parameters come from
  OdeModel model;
  Vector start;       ///< a state on or near the attractor
  double step = 0.0;  ///< a usual sampling step
};

/// All systems, in alphabetical order of their names.
const std::vector<TestSystem>& test_systems();

/// @throws ConfigError with the nearest name when there is no such system.
const TestSystem& test_system(const std::string& name);

}  // namespace lacuna
