// SPDX-License-Identifier: MIT
// Rivals between which an experiment has to decide.
#pragma once

#include <string>
#include <vector>

namespace lacuna::benchmarks {

/// Models of one plant; each of them may be the right one. All have an input u and a measured
/// channel y.
struct RivalCase {
  std::string name;
  std::vector<std::string> models;  ///< texts (.ode), two or three
  double low = -1.0, high = 1.0;    ///< range of u
  double duration = 10.0;           ///< of a run, old and new
  double step = 0.05;
  /// Steps of the old record, as fractions of the range.
  std::vector<double> old_steps = {0.5, 0.6, 0.55};
};

/// The cases, in their order.
const std::vector<RivalCase>& rival_cases();

}  // namespace lacuna::benchmarks
