// SPDX-License-Identifier: MIT
// A model along experiments that are not made yet: predictions and their derivatives.
#pragma once

#include <string>
#include <vector>

#include "lacuna/trajectories/design/plan.hpp"
#include "trajectories/fit/fit_engine.hpp"

namespace lacuna {

/// A model with what is computed once for all designs. A value; one per thread.
struct ModelRun {
  FitEngine engine;
  std::vector<Index> inputs;            ///< of the problem, for each of the model's
  std::vector<std::string> states;      ///< m
  Vector starts, deviations;            ///< m: where states begin, and by how much they may
                                        ///< be off; 0: exact
  Channels safe;                        ///< quantities with a safe range
  Vector values;                        ///< P: the present estimates
  Vector lower, upper;                  ///< P: ranges, infinite where there is none
};

/// @throws ArgumentError when a channel, an input or a safe range has a name that the model
///   lacks; ModelError for a delayed state.
ModelRun model_run(const PlanModel& model, const PlanProblem& problem);

/// Puts an experiment in the place of the one before; predictions are of this one from now on.
void load(ModelRun& run, const Experiment& experiment);

/// Takes steps so fine that halving them changes predictions by less than a tenth of their
/// noise, along each of these experiments; implicit ones for a stiff model.
void choose_steps(ModelRun& run, const std::vector<Experiment>& experiments);

/// The numbers of one path.
struct PathNumbers {
  Vector parameters;  ///< P
  Vector starts;      ///< m; empty: those of the experiment
};

/// Predictions of a model.
struct Prediction {
  Vector values;  ///< of samples that are taken, in units of their noise, time by time
  Matrix safe;    ///< n x quantities with a safe range
  Matrix channels;  ///< n x channels, in their own units
  bool is_finite = true;
};

/// @param experiment the one that is loaded.
Prediction predict(ModelRun& run, const Experiment& experiment, const PathNumbers& numbers);

/// Predictions with their derivatives.
struct LinearPrediction {
  Vector values;       ///< as of Prediction
  Matrix by_start;     ///< by initial states that may be off, each in its deviation
  Matrix by_parameter; ///< samples x P
  bool is_finite = true;
};

/// @param experiment the one that is loaded.
LinearPrediction linearise(ModelRun& run, const Experiment& experiment,
                        const PathNumbers& numbers);

/// Initial states in an experiment, m.
Vector starts_in(const ModelRun& run, const Experiment& experiment);

}  // namespace lacuna
