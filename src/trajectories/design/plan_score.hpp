// SPDX-License-Identifier: MIT
// What the evidence of an experiment is worth for the aim of a plan.
#pragma once

#include "evidence.hpp"

namespace lacuna {

/// What a score needs besides the evidence.
struct ScoreTerms {
  PlanAim aim = PlanAim::Rivals;
  RivalCriterion rivals = RivalCriterion::BayesFactor;
  PrecisionCriterion precision = PrecisionCriterion::D;
  double decisive = 3.0;
  std::vector<std::vector<Index>> chosen = {};  ///< numbers of each model
};

/// @throws ArgumentError for a chosen parameter that no model has.
ScoreTerms score_terms(const PlanProblem& problem, const PlanOptions& options,
                       const Rivals& rivals);

/// The larger the better, in units of a log probability; minus infinity where a path does not
/// stay finite.
double score_of(const ScoreTerms& terms, const Rivals& rivals, const DesignEvidence& evidence);

}  // namespace lacuna
