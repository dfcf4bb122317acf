// SPDX-License-Identifier: MIT
// A pipeline, and what it makes of records.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/dynamics/attractor/trapping_region.hpp"
#include "lacuna/model/equations/adequacy.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/invariants/relations.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "lacuna/regression/stages/formulation.hpp"
#include "lacuna/regression/stages/refiner.hpp"
#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna {

/// What a model is worth on samples that it was not fitted to.
enum class ValidationVerdict {
  FitsToNoise,    ///< predictions are off by no more than the noise of the samples
  Approximation,  ///< by more than the noise, and by a small fraction of the motion
  WrongLibrary,   ///< by a large fraction of the motion: the terms cannot describe the record
  Undecided,      ///< too few samples, no motion beyond the noise, or noise that is not known
  Incomplete,     ///< a limit cut a stage of the search that could change the verdict
};

/// "fits to noise", "approximation", "wrong library", "cannot tell", "incomplete".
std::string to_string(ValidationVerdict verdict);

/// Errors of the predictions of one state over many windows. In each window the initial state
/// is the one that fits best, of a map the sample; all three numbers are sqrt(sum r^2 /
/// freedom), state units.
struct PredictionError {
  std::string state;
  double error = 0.0;  ///< r: sample minus prediction of the model
  double noise = 0.0;  ///< of the measurement; what the error of a true model would be (of a
                       ///< map: of any function of the sample before)
  bool noise_estimated = false;  ///< false: none shows, `noise` is an upper bound
  double motion = 0.0;   ///< r with all rates 0 that have to be found: what is to be explained
  double freedom = 0.0;  ///< samples less what the initial states take of them

  /// Of neighbouring residuals in a window, where the noise is white; else 0.
  double correlation = 0.0;

  /// Error beyond the noise over motion beyond the noise.
  double fraction() const;
};

/// Predictions over windows of one length.
struct PredictionTest {
  double horizon = 0.0;  ///< length of a window, time units
  Index windows = 0;
  Index lost = 0;  ///< windows in which the model has no finite solution
  std::vector<PredictionError> states = {};  ///< measured ones
  Index unstarted = 0;  ///< windows with solutions of which none that fits was found
};

/// How well a model predicts samples that it was not fitted to.
struct Validation {
  ValidationVerdict verdict = ValidationVerdict::Undecided;
  std::string sentence = {};              ///< the verdict with its numbers, for people
  std::vector<std::string> records = {};  ///< sources of the samples
  std::string time_unit = {};
  Index samples = 0;      ///< held out
  bool given = false;     ///< records of their own; false: parts of those that were fitted
  bool refitted = false;  ///< coefficients were fitted without the samples
  PredictionTest one_step = {};          ///< the shortest windows that leave a residual
  PredictionTest windows = {};           ///< windows of a mean period
  Adequacy adequacy = {};                ///< what they say of each measured state
  std::vector<std::string> advice = {};  ///< what to try, where the model does not fit
};

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
