// SPDX-License-Identifier: MIT
// Least squares of the residuals over parameters and initial states.
#pragma once

#include <vector>

#include "fit_engine.hpp"
#include "lacuna/core/base/run_context.hpp"

namespace lacuna {

/// Which numbers are estimated, and what is known of them.
struct FitUnknowns {
  std::vector<Index> local;   ///< parameters that each record has for itself
  std::vector<Index> global;  ///< all others
  std::vector<std::optional<InitialValue>> initial;  ///< m
  std::vector<std::optional<Prior>> priors;          ///< P
  Vector lower, upper;                               ///< P, infinite where there is none
  /// Those of the local ones that vary about a typical value by a known spread: their priors.
  std::vector<Index> varying = {};
};

FitUnknowns fit_unknowns(const ParametrisedModel& model, std::vector<Index> local);

/// Places of the columns [initial states, parameters] in the order [initial, local, global].
std::vector<Index> column_order(const FitEngine& engine, const FitUnknowns& unknowns);

/// Blocks of neighbouring samples whose gradients show the correlation of the residuals.
constexpr Index kGradientBlocks = 40;

/// The problem linearised at a point.
struct FitLinear {
  /// R of [initial states, local, global parameters | residual] of each record.
  std::vector<Matrix> records;
  Matrix reduced;  ///< R of the global parameters | residual, all records, others eliminated
  Matrix prior;    ///< R of what is known of the global parameters | its residual

  /// Gradients by the global parameters of blocks of neighbouring samples, G x blocks; initial
  /// states and local parameters eliminated.
  Matrix gradients;
};

/// @param with_gradients whether `gradients` are wanted (a second pass).
FitLinear linearise(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& point,
                    const FitPath& path, const Gains& gains, bool with_gradients = false);

/// Where a minimisation ended.
struct FitMinimum {
  FitPoint point;
  FitPath path;
  bool converged = false;
  int iterations = 0;
  bool in_time = true;  ///< or a deadline ended it before
};

/// How many deviations a parameter is above what is known of it; not finite where the logarithm
/// is known and it is not above 0.
double prior_deviations(const Prior& prior, double value);

/// Cost of a path with what is known of the initial states and the parameters.
double total_cost(const FitUnknowns& unknowns, const FitPoint& point, const FitPath& path);

/// Values less unknowns; at least 1.
double degrees_of_freedom(const FitEngine& engine, const FitUnknowns& unknowns);

/// Minimises the cost by the method of Levenberg and Marquardt, parameters kept in their ranges
/// and initial states where the model is defined by an active set. A decrease below 1e-5 of the
/// cost per degree of freedom (1 moves a parameter by one standard error) ends it.
FitMinimum minimise(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                    const Gains& gains, int most_iterations, const RunContext& context);

/// The same, which ends past a deadline with the best point so far instead of an exception.
FitMinimum minimise_in_time(FitEngine& engine, const FitUnknowns& unknowns,
                            const FitPoint& start, const Gains& gains, int most_iterations,
                            const RunContext& context);

}  // namespace lacuna
