// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/system_model.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {

/// Signals that a bench can make.
enum class InputFamily {
  Steps,      ///< levels of equal length
  Prbs,       ///< two levels by a shift register
  Multisine,  ///< a sum of sines
  Chirp,      ///< a sine of rising or falling frequency
  Ramps,      ///< straight lines between knots
  Spline,     ///< a smooth curve through knots
};

/// "steps", "prbs", "multisine", "chirp", "ramps", "spline".
std::string to_string(InputFamily family);

/// The family of a name; nothing for another text.
std::optional<InputFamily> input_family_named(const std::string& name);

/// All of them.
std::vector<InputFamily> all_input_families();

/// What may be done with an input.
struct PlanInput {
  std::string name;
  double low = 0.0, high = 1.0;            ///< range, in the input's unit
  std::optional<double> rate = {};         ///< most change in a time unit
  std::optional<double> hold = {};         ///< time between changes; nothing: the sampling step
  std::vector<InputFamily> families = {};  ///< that may be tried; empty: all
  int pieces = 8;                          ///< levels, knots less one, or sines
};

/// Where a state begins in the next experiment: known, known to a deviation, or to be set.
struct PlanStart {
  std::string state;
  double low = 0.0, high = 0.0;  ///< range in which it can be set; equal: it is there
  double deviation = 0.0;        ///< by which it may be off; 0: exact
};

/// What is measured: an output or a state with white noise.
struct PlanChannel {
  std::string name;
  double noise = 0.0;  ///< standard deviation, > 0
};

/// A state or an output that has to stay in a range.
struct SafeRange {
  std::string name;
  double low = 0.0, high = 0.0;  ///< may be infinite
};

/// A model with what is known of its P free numbers (SystemModel::parametrised()).
struct PlanModel {
  std::string name;
  SystemModel system;
  /// P x P: Fisher information of what was measured; 0 x 0: what standard errors give.
  Matrix information = {};
  double weight = 1.0;  ///< its probability beside its rivals, > 0
};

/// An experiment as it was, or will be, made.
struct Experiment {
  Vector time;                         ///< n, from 0 on
  Matrix inputs;                       ///< n x inputs of the problem
  Matrix measured;                     ///< n x channels: 1 where a sample is taken, else 0
  std::vector<PlanStart> starts = {};  ///< of states, low = high; all others: PlanProblem
};

/// Models, and what can be done with the system.
struct PlanProblem {
  std::vector<PlanModel> models;
  std::vector<PlanInput> inputs;
  std::vector<PlanStart> starts = {};  ///< others begin as the model has it, else at 0
  std::vector<PlanChannel> channels;
  std::vector<SafeRange> safe = {};
  double duration = 1.0;                 ///< of a run, in the models' time unit
  double step = 0.01;                    ///< sampling step
  std::optional<int> measurements = {};  ///< so many samples whose times are free
  std::vector<Experiment> made = {};     ///< those behind PlanModel::information
};

/// What an experiment is made for; one model has no rivals.
enum class PlanAim {
  Rivals,      ///< to distinguish them
  Parameters,  ///< to determine numbers
  Both,        ///< to distinguish rivals, and where that is done to determine numbers
};

/// How rivals are compared; each after the parameters of the other are refitted.
enum class RivalCriterion {
  /// The least expected log Bayes factor of all pairs.
  BayesFactor,
  /// Sum of the expected log Bayes factors, weighted with both probabilities (Box and Hill,
  /// Technometrics 9:57-71, 1967, Eq. 15).
  BoxHill,
  /// Sum of squared distances from each model, weighted with its probability (Hunter and Reiner,
  /// Technometrics 7:307-323, 1965; where one model is right for certain, the T-criterion).
  HunterReiner,
};

/// What is made large of the information matrix M of numbers in units of their sizes.
enum class PrecisionCriterion {
  D,          ///< log det M
  A,          ///< -log trace of the inverse
  E,          ///< log of the least eigenvalue
  ModifiedE,  ///< -log of the ratio of the largest eigenvalue to the least
  Chosen,     ///< -sum of the log variances of chosen parameters
};

/// How a plan is sought.
struct PlanOptions {
  PlanAim aim = PlanAim::Rivals;
  RivalCriterion rivals = RivalCriterion::BayesFactor;
  PrecisionCriterion precision = PrecisionCriterion::D;
  std::vector<std::string> parameters = {};  ///< for PrecisionCriterion::Chosen
  int runs = 1;                              ///< one after the other, each the best addition
  int draws = 8;                  ///< of the parameters, in the expectation
  int safety_draws = 1000;        ///< of the parameters, in the check of the safe ranges
  double safe_probability = 0.95; ///< with which the safe ranges are kept
  int candidates = 64;            ///< random designs of each family
  int searches = 4;               ///< of them, the best, are improved
  int evaluations = 150;          ///< most designs of each search
  /// Of a number of which nothing is known: standard deviation over its size, which is its value;
  /// after a fit, its standard error where that is larger; where records leave it open, any value
  /// of its range. 0.5: its order is known; at 0.25 and 1 expected log Bayes factors change by
  /// about log 2 for each number.
  double spread = 0.5;
  /// Log Bayes factor that decides: 3 is "strong" (Kass and Raftery, J. Am. Stat. Assoc.
  /// 90:773-795, 1995).
  double decisive = 3.0;
};

/// What an experiment does for a pair of rivals.
struct PairPromise {
  std::string truth, rival;
  double log_bayes_factor = 0.0;  ///< expected for `truth` where it is right
  double sigma = 0.0;  ///< distance that is left after the refit, standard deviations
  double power = 0.0;  ///< probability of a log Bayes factor above PlanOptions::decisive
  /// The same from the experiments that were made, repeated for as long; NaN: none.
  double repeated = 0.0;
};

/// What an experiment does for a parameter of a model.
struct ParameterPromise {
  std::string model, name, unit;
  double value = 0.0;
  std::optional<double> before = {};  ///< standard error; nothing: not known
  /// Root mean square over draws of the numbers; nothing: still not known.
  std::optional<double> after = {};
  /// From the experiments that were made, repeated for as long.
  std::optional<double> repeated = {};
};

/// What a model predicts in the experiment.
struct PredictedResponse {
  std::string model, channel, unit;
  Vector mean;  ///< n
  Vector low, high;  ///< n, of 95 % of the draws, without noise
};

/// A planned run.
struct PlannedRun {
  Experiment experiment;
  std::vector<InputFamily> families;  ///< of the inputs
  std::vector<PredictedResponse> responses = {};
  double leaves = 0.0;  ///< fraction of the draws in which it leaves a safe range, worst model
};

/// The next experiment.
struct Plan {
  std::vector<PlannedRun> runs;
  std::vector<PairPromise> pairs;
  std::vector<ParameterPromise> parameters;
  bool is_feasible = true;           ///< whether it decides or narrows anything, safely
  std::vector<std::string> reasons;  ///< what it cannot do, and why
  Index evaluations = 0;             ///< designs that were judged
  Index simulations = 0;             ///< of a model along a design
  /// How much longer the experiments that were made would have to be repeated for the same
  /// (the least log Bayes factor, or the mean variance); nothing: none were made.
  std::optional<double> time_saved = {};
  std::vector<StageDone> stages = {};  ///< the searches of the runs; what a deadline left out
};

/// The Fisher information of records about the free numbers of a fitted model, P x P: that of
/// initial states is taken off (they are estimated); noise as the residuals have it.
/// @param data the records of the fit.
/// @throws DataError as fit().
Matrix information_of(const Fit& fit, const Dataset& data);

/// Records of a fit as experiments, with the initial states that were estimated.
/// @throws ArgumentError where the problem has an input that the records lack.
std::vector<Experiment> experiments_of(const Fit& fit, const Dataset& data,
                                       const PlanProblem& problem);

/// Plans the experiment that distinguishes models, or determines their numbers.
///
/// With S_j the derivatives of the n measured values, in units of their noise, by the numbers
/// of model j, and M_j the information on these, measured values have the covariance C_j = 1 +
/// S_j M_j^-1 S_j' under model j. For the difference d of predictions the distance that is left
/// after rival j is refitted is d' C_j^-1 d = |d|^2 - d' S_j (M_j + S_j' S_j)^-1 S_j' d. The
/// expected log Bayes factor for i where i is right is
/// (E d' C_j^-1 d - tr (M_j + S_j' S_j)^-1 S_j' S_j + log det C_j - log det C_i) / 2, with the
/// expectation over draws of the numbers of i; of the design that is taken, rivals are refitted
/// by iterated Gauss-Newton steps. Designs are sought from seeded random ones, the best of
/// which are improved by NLopt's Sbplx. Same problem and seed, same plan, whatever the threads
/// are.
/// @throws ArgumentError for a problem that does not fit together (names, ranges, sizes);
///   ModelError for a delayed state and as SystemModel::parametrised(); Cancelled; OutOfTime
///   where the deadline passes before a design is judged and checked.
Plan plan_experiment(const PlanProblem& problem, const PlanOptions& options = {},
                     const RunContext& context = {});

}  // namespace lacuna
