// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "diagnose/journey/gap.hpp"

namespace lacuna {

/// What runs freely, and along what.
struct FreeRunTask {
  const OdeModel& model;           ///< with output channels and memory states
  const std::vector<Matrix>& paths;  ///< per record n x m: where its states are on the records
  const Dataset& records;          ///< the measured values, its first states those of the model
  const NoiseModel& noise;         ///< of the first states
  const Vector& scale;             ///< m: deviations of the states over the records
  const std::vector<Index>& begins;  ///< per record the sample at which the run begins
};

/// Runs a model once over the whole of each record, from where it is on it at the first sample
/// and with nothing but the inputs, and compares it as far as it foretells itself: a run from
/// next to that start, off by the noise, says how far that is (a chaotic system forgets its
/// start, and an unstable one shows it). Nothing where that is less than `least` samples.
std::optional<RunApart> run_freely(const FreeRunTask& task, Index least,
                                   const RunContext& context);

}  // namespace lacuna
