// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/run_context.hpp"
#include "lacuna/data/dataset.hpp"
#include "lacuna/pipeline/result.hpp"
#include "lacuna/stages/basis.hpp"
#include "lacuna/stages/formulation.hpp"
#include "lacuna/stages/refiner.hpp"
#include "lacuna/stages/regressor.hpp"
#include "lacuna/stages/term_filter.hpp"
#include "lacuna/stages/term_pruner.hpp"

namespace lacuna {

/// The terms that one equation may have.
struct EquationTerms {
  std::string state;               ///< of dx/dt
  std::vector<std::string> terms;  ///< formulas in states, inputs and t
};

/// A composition of stages. An aggregate: a forgotten stage does not compile.
struct Pipeline {
  Stage<Basis> basis;
  Stage<Formulation> formulation;
  Stage<TermFilter> filter;
  Stage<Regressor> regressor;
  Stage<TermPruner> pruner;
  Stage<Refiner> refiner;
  std::vector<EquationTerms> equations = {};  ///< libraries of their own; none: the basis
};

/// Identifies one equation per state: basis -> formulation -> filter, then per equation
/// pruner (refitting with the regressor) and a final fit. An equation the dataset knows as an
/// identity (Dataset::rate_of) is taken over with coefficient 1. The refiner then fits the
/// model to the trajectories and may change its structure.
/// @throws DataError, ConfigError as the stages do; Cancelled on a stop request.
IdentificationResult identify(const Dataset& data, const Pipeline& pipeline,
                              const RunContext& context = {});

}  // namespace lacuna
