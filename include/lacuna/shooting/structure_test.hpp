// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/shooting/score_system.hpp"

namespace lacuna {

/// When the structure of a refined model is changed.
struct StructureOptions {
  /// Probability that a record of a right model makes any candidate come in: each of M
  /// candidates has to be significant at `false_alarm` / M.
  double false_alarm = 0.01;

  /// Where residuals are no noise, the model is an approximation and any term helps a little:
  /// then a term comes in only if it takes away at least this share of chi squared.
  double least_share = 0.1;

  int max_changes = 30;  ///< removals and additions together
  RefineOptions refine = {};
};

/// A term that left or entered the model after a refinement.
struct StructureChange {
  bool added = false;
  Index equation = 0;
  std::string term;
  double score = 0.0;  ///< coefficient / standard error that decided
  double bound = 0.0;  ///< what it was held against
};

/// A model whose terms are all significant and beside which no candidate is.
struct StructureTest {
  Refinement refinement;                 ///< of the last structure
  std::vector<StructureChange> changes;  ///< in order
  bool settled = true;                   ///< false when max_changes ended it
};

/// Refines a model and tests its structure by the residuals of the trajectories: the least
/// significant free term whose 95 % interval contains zero goes, one at a time, each time with
/// a refinement of what is left; then the candidate that the residuals ask for most, if it is
/// significant, comes in, and so on until nothing changes. Terms with a prior, terms with shape
/// parameters and the last term of an equation stay. A term that came in and left again does
/// not come back.
/// @param candidates terms to try, as candidates_from(); those that the model has are left out.
/// @throws as refine() and ScoreSystem.
StructureTest test_structure(const ParametrisedModel& model, const Dataset& record,
                             const std::vector<CandidateTerm>& candidates,
                             const StructureOptions& options = {},
                             const RunContext& context = {});

}  // namespace lacuna
