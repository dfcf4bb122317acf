// SPDX-License-Identifier: MIT
// What a chosen experiment is expected to do.
#pragma once

#include "plan_score.hpp"

namespace lacuna {

/// The evidence of the plan, and of the experiments that were made, repeated for as long.
struct Expected {
  DesignEvidence planned, made;  ///< `made` is empty where nothing was
};

/// All pairs of rivals, with exact refits.
std::vector<PairPromise> pair_promises(const PlanProblem& problem, const Rivals& rivals,
                                       const Expected& expected,
                                       const std::vector<Experiment>& experiments,
                                       double decisive, const RunContext& context);

/// All free numbers of all models. What experiments bring depends on the numbers, which are
/// known to their draws only: variances after them are means over the draws.
std::vector<ParameterPromise> parameter_promises(const PlanProblem& problem,
                                                 const Rivals& rivals, const Expected& expected,
                                                 const std::vector<Experiment>& experiments,
                                                 const RunContext& context);

/// Sets what a plan cannot do, and whether it does anything.
void judge(Plan& plan, const ScoreTerms& terms, const PlanOptions& options);

/// By which factor the experiments that were made take longer to the same score; at most 1e4.
/// Nothing where none were made.
std::optional<double> time_saved(const ScoreTerms& terms, const Rivals& rivals,
                                 const Expected& expected);

/// Predictions of all models in a run, with bands of draws.
std::vector<PredictedResponse> responses_in(const PlanProblem& problem, const Rivals& rivals,
                                            const Experiment& experiment, std::uint64_t seed);

}  // namespace lacuna
