// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/smoother/noise_model.hpp"

#include <algorithm>

namespace lacuna {

Index NoiseModel::measured() const noexcept {
  return static_cast<Index>(std::count_if(measurement.begin(), measurement.end(),
                                          [](const auto& entry) { return entry.has_value(); }));
}

}  // namespace lacuna
