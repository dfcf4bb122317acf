// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/smoother/noise_model.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {

Index NoiseModel::measured() const noexcept {
  return static_cast<Index>(std::count_if(measurement.begin(), measurement.end(),
                                          [](const auto& entry) { return entry.has_value(); }));
}

double NoiseModel::rounded(std::size_t state) const noexcept {
  return std::hypot(measurement[state].value_or(0.0), lattice_of(state) / std::sqrt(12.0));
}

}  // namespace lacuna
