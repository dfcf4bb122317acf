// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "trajectories/sensitivities/rates.hpp"
#include "trajectories/sensitivities/stage_signals.hpp"

namespace lacuna {

/// A record as a model sees it, trajectories one behind the other: N samples.
struct ShootingRecord {
  Vector time;                             ///< N
  std::vector<Index> begins;               ///< first sample of each trajectory, then N
  std::vector<std::optional<Index>> rows;  ///< of each state of the model: its column in values
  std::vector<Index> measured;             ///< states of the model that have a column
  Matrix values;                           ///< N x measured
  Matrix inputs;                           ///< N x record inputs
  std::vector<Interpolation> holds = {};   ///< of the inputs

  Index samples() const noexcept { return time.size(); }
  Index trajectories() const noexcept { return static_cast<Index>(begins.size()) - 1; }
};

/// States and inputs are found by name; a state without a column is not measured.
/// @throws DataError when no state is measured or an input is missing.
ShootingRecord shooting_record(const ParametrisedModel& model, const Dataset& record);

/// Signals of all trajectories; delayed variables are those of the record.
/// @throws DataError for a delayed state that is not measured.
StageSignals stage_signals(const ShootingRecord& record, const Rates& rates,
                           const StepScheme& scheme);

}  // namespace lacuna
