// SPDX-License-Identifier: MIT
// Records of systems that lack nothing, with a few samples that are off.
#pragma once

#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::hidden {

/// A record of a model that is right, in which a few values of one state are off.
struct SpikeCase {
  std::string name;         ///< "lag, last used sample, 1 deviation"
  std::string model;        ///< of spike_model()
  Index state = 0;          ///< that has the spikes
  std::vector<Index> at;    ///< samples, of 400; the first 300 are used, the others checked on
  double size = 1.0;        ///< standard deviations of the state
  double noise = 0.005;     ///< of all states, standard deviations of each
  bool alternates = false;  ///< whether spikes change their sign in turn
};

/// Made before any of them was tried.
std::vector<SpikeCase> spike_cases();

/// "lag", "mass", "tank", "wave".
OdeModel spike_model(const std::string& name);

/// 400 samples with spikes, of a drive that is a sum of sines.
Dataset spike_record(const SpikeCase& one, std::uint64_t seed);

}  // namespace lacuna::hidden
