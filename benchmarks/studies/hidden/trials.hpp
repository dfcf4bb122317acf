// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "trial.hpp"

namespace lacuna::benchmarks {

/// Every hidden case at 0, 0.1, 1 and 5 % noise.
std::vector<Trial> case_trials();

/// One case of each effect family at a tenth, a third and the whole of its strength, at 0.1, 1
/// and 5 % noise.
std::vector<Trial> power_trials();

/// Records in which nothing is missing: all complete systems in turn, with every kind of noise
/// at 0.1, 1 and 5 %.
std::vector<Trial> alarm_trials(int count);

}  // namespace lacuna::benchmarks
