// SPDX-License-Identifier: MIT
// Rivals between which an experiment has to decide.
#pragma once

#include <string>
#include <vector>

namespace lacuna::benchmarks {

/// Models of one plant; each of them may be the right one. All have an input u and a measured
/// channel y. Runs begin at rest, with u in the middle of its range.
struct RivalCase {
  std::string name;
  std::vector<std::string> models;  ///< texts (.ode), two or three; @: y at rest
  double low = -1.0, high = 1.0;    ///< range of u
  double duration = 10.0;           ///< of the old record, and the most of a new one
  double step = 0.05;
};

/// The cases, in their order.
const std::vector<RivalCase>& rival_cases();

}  // namespace lacuna::benchmarks
