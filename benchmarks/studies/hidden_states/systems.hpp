// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::hidden_states {

/// What a case is about.
enum class Kind {
  Effect,        ///< something is missing
  Null,          ///< nothing is missing
  Undetermined,  ///< nothing is missing, and the records do not determine something
};

/// A system of which not every state is measured.
struct System {
  std::string name;
  Kind kind = Kind::Null;
  std::string truth;    ///< text model; statements end with ';'
  std::string nominal;  ///< what it lacks left out; coefficients are perturbed
  std::vector<std::string> measured = {};  ///< states that have a column
  std::vector<double> start = {};          ///< of each state
  double step = 0.1;                       ///< time between samples
  Index samples = 1500;
  double low = 0.0, high = 0.0, period = 0.0;  ///< range and time scale of inputs
  std::vector<std::string> equations = {};     ///< in which the effect is right
  std::vector<std::string> names = {};         ///< that are right
};

/// All of them.
std::vector<System> all_systems();

/// The nominal model; its coefficients are off by up to 15 %.
OdeModel nominal_of(const System& system);

/// Records of a system with noise.
struct Records {
  Dataset find, check;  ///< as measured
};

/// @param noise fraction of each measured state's standard deviation.
Records make_records(const System& system, double noise, std::uint64_t seed);

}  // namespace lacuna::hidden_states
