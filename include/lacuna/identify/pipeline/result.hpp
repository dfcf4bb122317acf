// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/dynamics/attractor/trapping_region.hpp"
#include "lacuna/identify/pipeline/validation.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/invariants/relations.hpp"
#include "lacuna/regression/stages/refiner.hpp"

namespace lacuna {

/// What became of one candidate term in one equation.
struct TrailEntry {
  std::string equation;  ///< name of the state
  std::string term;
  bool kept = false;
  std::string stage = {};  ///< who removed it: "filter abm", "pruner minor-terms"; "" when kept
  std::string quantity = {};  ///< what was looked at
  double value = 0.0;         ///< what it was (when kept: the coefficient)
  double threshold = 0.0;     ///< what it was compared with
  int step = 0;               ///< in which step of the stage, from 1
};

/// How well one equation fits.
struct EquationFit {
  std::string equation;       ///< name of the state
  bool identity = false;      ///< known without a fit; the numbers below are then 0
  Index rows = 0;             ///< n
  double residual_rms = 0.0;  ///< |y - Theta h| / sqrt(n), in the unit of the target
  double target_rms = 0.0;    ///< |y| / sqrt(n)

  /// rms of the target that measurement noise alone gives, when it can be known.
  std::optional<double> noise_floor = {};

  /// Residuals of the trajectories over the noise of the record, where they were fitted: 1 when
  /// nothing but noise is left.
  std::optional<double> misfit = {};

  /// Whether nothing but noise is left: by the misfit where there is one, else whether the
  /// residual is not above twice the noise floor; nothing when that is not known.
  std::optional<bool> fits_to_noise = {};

  /// The warning that says why it does not; empty where it is not said.
  std::string doubt = {};

  bool converged = true;  ///< of the final regression
  int iterations = 0;
};

/// By how much later an input acts than it is recorded.
struct DeadTime {
  std::string input;
  double time = 0.0;  ///< time units of the record
  /// Of the time, where it was found and not given.
  std::optional<double> standard_error = {};
  std::optional<std::array<double, 2>> ci95 = {};
};

/// A model and how it came about.
struct IdentificationResult {
  OdeModel model;
  Vector noise;                       ///< estimated measurement noise per state, state units;
                                      ///< empty for a map, whose samples do not show it
  std::vector<EquationFit> fit;       ///< one per state
  std::vector<TrailEntry> trail;      ///< every candidate term that an equation had
  std::vector<PathStep> path;         ///< models of each equation, where the refiner made them
  std::vector<std::string> warnings;  ///< what a user should know: an empty equation, ...
  std::vector<DeadTime> dead_times = {};  ///< of the inputs that act late
  /// What the library alone gives, where forms beside it were taken in.
  std::optional<OdeModel> library_alone = {};
  /// What the model is worth on samples that it was not fitted to, where that was looked at;
  /// see take_in().
  std::optional<Validation> validation = {};
  /// Whether the equations fit to the noise: by predictions where these were made, else by
  /// their residuals.
  Adequacy adequacy = {};
  /// Polynomials that are constant on the data, where they were looked for.
  std::vector<Relation> relations = {};
  /// Whether all paths of the model stay bounded, as far as its energy shows it.
  TrappingAnswer trapping = {};
  /// Stages that were done to come to this, in order, and those that were left out.
  std::vector<StageDone> stages = {};
};

}  // namespace lacuna
