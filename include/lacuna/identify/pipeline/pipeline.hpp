// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/identify/pipeline/result.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "lacuna/regression/stages/formulation.hpp"
#include "lacuna/regression/stages/refiner.hpp"
#include "lacuna/regression/stages/regressor.hpp"
#include "lacuna/regression/stages/term_filter.hpp"
#include "lacuna/regression/stages/term_pruner.hpp"

namespace lacuna {

/// The terms that one equation may have.
struct EquationTerms {
  std::string state;               ///< of dx/dt
  std::vector<std::string> terms;  ///< formulas in states, inputs and t
};

/// One summand of what coefficients have to satisfy.
struct NamedCoefficient {
  std::string state;  ///< of dx/dt
  std::string term;   ///< a formula
  double factor = 1.0;
};

/// How a sum of coefficients compares with a value; both inequalities include the value.
enum class ConstraintRelation { Equal, AtMost, AtLeast };

/// sum_i factor_i h_i = value (<=, >=), over coefficients of terms in equations. One summand alone
/// fixes a coefficient, or bounds it; terms of inequalities do not enter libraries of equations.
struct EquationConstraint {
  std::vector<NamedCoefficient> summands;
  double value = 0.0;
  ConstraintRelation relation = ConstraintRelation::Equal;
};

/// Constraints under which the quadratic part keeps the energy sum_i x_i^2: for every product
/// x_i x_j x_k, its coefficients in x_i dx_i/dt + x_j dx_j/dt + x_k dx_k/dt add up to 0.
std::vector<EquationConstraint> energy_preserving(const std::vector<Quantity>& states);

/// A composition of stages. An aggregate: a forgotten stage does not compile.
struct Pipeline {
  Stage<Basis> basis;
  Stage<Formulation> formulation;
  Stage<TermFilter> filter;
  Stage<Regressor> regressor;
  Stage<TermPruner> pruner;
  Stage<Refiner> refiner;
  std::vector<EquationTerms> equations = {};  ///< libraries of their own; none: the basis
  std::vector<EquationConstraint> constraints = {};  ///< terms in them enter the library
  bool energy_preserving = false;  ///< see energy_preserving(); terms do not enter
  std::optional<OdeModel> start = {};  ///< where the refiner begins; none: at the regression
};

/// Names in IdentificationResult::stages: regression and elimination, and the refiner; where time
/// is up before the equations are there, what of their choice was left out.
inline constexpr const char* kEquationsStage = "equations";
inline constexpr const char* kLibraryStage = "terms of the highest degrees";
inline constexpr const char* kFilterStage = "filter";
inline constexpr const char* kEliminationStage = "elimination";
inline constexpr const char* kTrajectoriesStage = "trajectories";

/// Is given a whole result before a better one is sought.
using FirstAnswer = std::function<void(const IdentificationResult&)>;

/// Identifies one equation per state: basis -> formulation -> filter, then per equation
/// pruner (refitting with the regressor) and a final fit. An equation the dataset knows as an
/// identity (Dataset::rate_of) is taken over with coefficient 1. The refiner then fits the
/// model to the trajectories and may change its structure. Coefficients
/// satisfy the constraints; those of absent terms are 0. Of long records all samples determine
/// the terms, an excerpt the rest.
/// In a team only the leader's result is refined. A deadline ends the refinement: the model is
/// that of the regression then, and `stages` has that. Where it comes before, a large library
/// loses its terms of the highest degrees, candidates are not filtered, and equations are chosen
/// from the terms that explain most; `stages` and the warnings have these, too. A team chooses
/// its equations without hurry.
/// @param records a Dataset, or records that are read in pieces.
/// @param first is given the result of the regression before it is refined; may be empty.
/// @throws DataError, ConfigError as the stages do; Cancelled on a stop request.
IdentificationResult identify(const RecordStream& records, const Pipeline& pipeline,
                              const RunContext& context = {}, const FirstAnswer& first = nullptr);

}  // namespace lacuna
