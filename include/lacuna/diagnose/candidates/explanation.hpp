// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// An effect with its numbers.
struct FittedEffect {
  Candidate candidate;
  Vector shapes;             ///< one value per shape parameter
  double coefficient = 0.0;  ///< of the form
  double deviation = 0.0;    ///< its standard error
  /// Standard errors of the shapes; empty where they were not fitted, 0 at an end of the range.
  Vector shape_deviations = {};
};

/// A nominal model with effects, brought onto records.
struct Explanation {
  std::vector<FittedEffect> effects;
  Assimilation
      fit;  ///< its model has the effects' terms and memory states behind the nominal ones

  /// Free parameters of the effects: coefficients and shapes.
  Index parameters() const noexcept;
};

/// A model and its records with room for effects.
struct AugmentedProblem {
  OdeModel model;  ///< terms and memory states of the effects behind the nominal ones
  Dataset data;    ///< memory states are columns that were not measured
  std::vector<CoefficientPlace> free;
  std::vector<CoefficientPlace> effect_places;  ///< one per effect with Place::Rate, in order
  std::vector<ChannelTerm> channel_terms;  ///< one per effect with Place::Channel, in order
  std::vector<Matrix> bridges = {};        ///< per record LinearisedRecord::bridge, or none
};

/// Puts effects into a model and their memory states into its records.
/// @param paths per record the best estimate of the nominal states, n x m.
AugmentedProblem augment(const OdeModel& nominal, const Dataset& data,
                         const std::vector<CoefficientPlace>& free,
                         const std::vector<FittedEffect>& effects,
                         const std::vector<Matrix>& paths);

/// What effects are fitted jointly with. Everything outlives it.
struct JointFitTask {
  const Dataset& data;
  const OdeModel& nominal;
  const AssimilationOptions& options;  ///< nominal coefficients that are free, passes
  const RunContext& context;
  /// Of the nominal model alone, fitted, where it is known: what an effect of no size comes to.
  double bare_deviance = std::numeric_limits<double>::infinity();
};

/// Fits a nominal model and effects to records with the shapes as they are, in few passes: good
/// enough to decide which explanations are worth a full fit.
/// @param start the nominal model, perhaps with other effects, brought onto the same records;
///   where the fit starts.
Explanation explain_roughly(const JointFitTask& task, const Assimilation& start,
                            const std::vector<FittedEffect>& effects);

/// Fits a nominal model and effects to records, all coefficients and shapes jointly: the shapes
/// by Gauss-Newton steps in which the rate of change of a form with a shape is one more column,
/// as long as the likelihood rises. Arguments as of explain_roughly().
Explanation explain(const JointFitTask& task, const Assimilation& start,
                    const std::vector<FittedEffect>& effects);

/// The explanation with standard errors that hold whatever its shapes are: the covariance of
/// the joint linearised problem of everything that was fitted. In a fit they are those at the
/// shapes as they are.
Explanation with_joint_errors(const JointFitTask& task, Explanation explanation);

}  // namespace lacuna
