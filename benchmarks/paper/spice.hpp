// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "output.hpp"

namespace lacuna::benchmarks {

/// Simulates netlists/`name`.cir for each name, two at a time, and gives the circuit's x, y, z
/// in V on the paper's grid, time in tau. Nothing, and a note in the output, for what cannot be
/// simulated.
std::vector<std::optional<Dataset>> simulate_netlists(const std::vector<std::string>& names,
                                                      Output& output);

}  // namespace lacuna::benchmarks
