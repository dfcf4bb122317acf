// SPDX-License-Identifier: MIT
// Noise that is handed on, so that no record is looked at twice.
#pragma once

#include <vector>

#include "core/base/check.hpp"
#include "lacuna/data/records/noise.hpp"

namespace lacuna {

/// What estimate_noise() has, of states that were analysed.
inline Vector white_noise(const std::vector<StateNoise>& states) {
  Vector noise(static_cast<Index>(states.size()));
  for (Index k = 0; k < noise.size(); ++k) noise[k] = states[static_cast<std::size_t>(k)].white;
  return noise;
}

/// @throws ArgumentError unless what is known of the noise is that of each state of some
/// records.
template <class Noise>
void check_known(const std::optional<Noise>& known, const Dataset& data, const char* where) {
  check_argument(!known || static_cast<Index>(known->size()) == data.state_count(), where,
                 "the known noise is not one per state", "give that of each state");
}

/// The known noise of records, or what analyse_noise() finds.
inline std::vector<StateNoise> known_or_analysed(const KnownNoise& known, const Dataset& data,
                                                 int threads = 1) {
  return known ? *known : analyse_noise(data, threads);
}

/// The same of white noise: what estimate_noise() finds.
inline Vector known_or_estimated(const std::optional<Vector>& known, const Dataset& data,
                                 int threads = 1) {
  return known ? *known : estimate_noise(data, threads);
}

}  // namespace lacuna
