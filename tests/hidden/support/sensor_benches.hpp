// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hidden/support/benches.hpp"

namespace lacuna::hidden {

/// A device of twins.hpp that lacks nothing, or whose input acts late, behind sensors that show
/// something else than the state at the time of the sample: filters of first and second order,
/// means of the last samples, differences of positions in place of a speed. The list was written
/// before anything that it tests was changed.
struct SensorBench {
  std::string name;
  bool acts_late = false;  ///< whether the input does: then that is to be named
  /// Whether records distinguish an input that acts late from what the sensors do. Where one
  /// sensor shows all states and all of them late, they do not: both are true.
  bool distinguished = true;
  std::uint64_t seed = 0;  ///< decides the numbers of the device
};

/// Means of the last samples; of the first samples means of those that there are.
Vector mean_of_last(const Vector& x, Index window);

/// All of them. Where none of the input is late ("...-null"), only faults of sensors are names.
std::vector<SensorBench> all_sensor_benches();

/// Names that say something of a sensor.
const std::vector<std::string>& names_of_sensors();

/// The records of a bench; its truth is in hidden.effects.
BenchCase made_bench(const SensorBench& bench);

}  // namespace lacuna::hidden
