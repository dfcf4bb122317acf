// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/data/dataset.hpp"
#include "lacuna/dynamics/butcher_tableau.hpp"
#include "rates.hpp"

namespace lacuna {

/// How sampling intervals are integrated: equal steps of one explicit method.
struct StepScheme {
  const ButcherTableau* tableau = nullptr;
  Index substeps = 1;

  bool operator==(const StepScheme&) const = default;
};

/// A record as a model sees it, trajectories one behind the other: N samples.
struct ShootingRecord {
  Vector time;                             ///< N
  std::vector<Index> begins;               ///< first sample of each trajectory, then N
  std::vector<std::optional<Index>> rows;  ///< of each state of the model: its column in values
  std::vector<Index> measured;             ///< states of the model that have a column
  Matrix values;                           ///< N x measured
  Matrix inputs;                           ///< N x record inputs

  Index samples() const noexcept { return time.size(); }
  Index trajectories() const noexcept { return static_cast<Index>(begins.size()) - 1; }
};

/// States and inputs are found by name; a state without a column is not measured.
/// @throws DataError when no state is measured or an input is missing.
ShootingRecord shooting_record(const ParametrisedModel& model, const Dataset& record);

/// Signals of the record (inputs, t, delayed variables) at every stage of every step. Steps of
/// sampling interval i are i * substeps, ...; at the last sample of a trajectory their length
/// is 0.
struct StageSignals {
  StepScheme scheme;
  Vector lengths;              ///< of the steps, N * substeps
  std::vector<Matrix> stages;  ///< per stage: N * substeps x Rates::signals()
};

/// Inputs between samples are cubic Lagrange polynomials; delayed variables are those of the
/// record, its first sample before it begins.
/// @throws DataError for a delayed state that is not measured.
StageSignals stage_signals(const ShootingRecord& record, const Rates& rates,
                           const StepScheme& scheme);

}  // namespace lacuna
