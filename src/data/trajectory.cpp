// SPDX-License-Identifier: MIT
#include "lacuna/data/trajectory.hpp"

#include <cmath>

namespace lacuna {

std::optional<double> uniform_step(const Trajectory& trajectory, double tolerance) {
  const Vector& time = trajectory.time;
  if (time.size() < 2) return std::nullopt;
  const double mean = (time[time.size() - 1] - time[0]) / static_cast<double>(time.size() - 1);
  const auto steps = (time.tail(time.size() - 1) - time.head(time.size() - 1)).array();
  const bool uniform = ((steps - mean).abs() <= tolerance * std::abs(mean)).all();
  return uniform ? std::optional<double>(mean) : std::nullopt;
}

}  // namespace lacuna
