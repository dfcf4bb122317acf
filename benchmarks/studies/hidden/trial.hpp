// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hidden/support/score.hpp"
#include "lacuna/config/registry.hpp"

namespace lacuna::benchmarks {

/// One diagnosis that is to be made.
struct Trial {
  hidden::HiddenCase hidden;
  double strength = 1.0;
  double level = 0.01;  ///< of the noise, relative to the states
  std::uint64_t seed = 1;
};

/// What came of it.
struct Outcome {
  hidden::Score score;
  double gap = 0.0;       ///< after, on the record that was held out
  double true_gap = 0.0;  ///< of the true model there; 0 where it cannot be run
  double seconds = 0.0;
  std::string failure;  ///< message of an exception; empty when there was none
};

/// Makes the records of a trial, diagnoses them and holds the answer against the truth.
Outcome run_trial(const Trial& trial, const Registry& registry);

/// All trials, spread over the processor's cores; outcomes in the order of the trials. Progress
/// goes to standard error.
std::vector<Outcome> run_trials(const std::vector<Trial>& trials, const Registry& registry);

}  // namespace lacuna::benchmarks
