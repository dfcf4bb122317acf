// SPDX-License-Identifier: MIT
// Parameters estimated on trajectories, with intervals, and models compared by them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/model/equations/adequacy.hpp"
#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {

/// A channel whose values have known standard deviations.
struct KnownDeviation {
  std::string channel;  ///< a measured state or output
  std::string column;   ///< input of the records that has them, all above 0
};

/// How a model of known structure is fitted.
struct FitOptions {
  int restarts = 8;       ///< at most so many other starts where residuals are above the noise
  /// At most so many starts anywhere in the ranges of parameters, wherever the first fit ends;
  /// nothing: range_starts where a range is wide and residuals are above the noise.
  std::optional<int> starts = {};
  /// With few samples, and with many: one in seven comes to the best minimum of published
  /// problems.
  int range_starts = 60, range_starts_of_many = 10;
  /// Quick: from the given start alone, intervals by standard errors. Full: profiles of the
  /// likelihood of every parameter, whatever they cost.
  Thoroughness effort = Thoroughness::Normal;
  double spread = 3.0;    ///< by which factor they differ from the model's numbers
  Index window = 50;      ///< first samples of a held-out record that give its initial state
  Index prediction = 10;  ///< samples ahead of the error of prediction
  /// Where records begin and initial values hold; nothing: where the model has it
  /// (OdeModel::initial_time()), or at the first row of each.
  std::optional<double> start_time = {};
  bool profile = false;   ///< whether profiles of the likelihood are wanted, at any cost
  /// A start of other fits is all that is wanted: steps and sizes of the noise stay those of the
  /// search, intervals are those of standard errors. Past a deadline fit() throws OutOfTime then.
  bool rough = false;
  /// Normal noise of known size in each sample, in the place of one deviation of the channel.
  std::vector<KnownDeviation> deviations = {};
  bool bands = false;  ///< whether bands of the free runs are wanted
  KnownNoise noise = {};  ///< of each column of the records; nothing: analyse_noise() finds it
};

/// The spread of a number over the records (individuals): a standard deviation, of the logarithm
/// where it varies by a factor.
struct FittedSpread {
  bool by_factor = false;
  double start = 0.0;  ///< as given
  double value = 0.0;  ///< the estimate; 0 where the records show none
  std::optional<double> standard_error = {};
  std::optional<std::array<double, 2>> ci95 = {};  ///< nothing where the records show none
  std::optional<double> at_most = {};  ///< upper 97.5 % limit where the records show none
  /// 1 - deviation of the individual values / spread: near 1 little is known of each.
  double shrinkage = 0.0;
};

/// A number that was fitted.
struct FittedParameter {
  std::string name;       ///< "w: sin(th)" or the name of a parameter
  std::string unit = {};  ///< of a parameter
  double start = 0.0;     ///< as given
  double value = 0.0;     ///< the estimate
  std::optional<double> standard_error = {};
  std::optional<std::array<double, 2>> ci95 = {};  ///< nothing where it is not determined
  std::optional<double> at_least = {};  ///< lower 97.5 % limit, where the upper one is open
  std::optional<double> at_most = {};   ///< upper 97.5 % limit, where the lower one is open
  std::optional<std::string> bound = {};           ///< "min" or "max" where it ended there
  std::vector<double> per_record = {};             ///< where each record has its own
  std::vector<double> per_record_errors = {};      ///< standard errors; NaN: not determined
  /// Where it varies over the records; `value` is that of a typical record then, `per_record`
  /// has the most probable values of each.
  std::optional<FittedSpread> spread = {};
};

/// Two numbers whose estimates depend on one another.
struct FitCorrelation {
  std::string first, second;
  double correlation = 0.0;
};

/// An initial state of one record.
struct FittedStart {
  std::string state;
  double value = 0.0;
  bool fixed = false;
  std::optional<double> standard_error = {};  ///< nothing where it is not determined
};

/// How a model meets one channel. What nothing was compared for is NaN.
struct FitQuality {
  std::string channel, unit;
  Index samples = 0;         ///< compared with the free run
  Index predicted = 0;       ///< compared with predictions
  double rmse = 0.0;         ///< free run from the fitted initial state
  double fit_percent = 0.0;  ///< 100 (1 - |y - model| / |y - mean y|)
  double noise = 0.0;        ///< what the samples show of their noise; 0: not known
  double prediction = 0.0;   ///< rms error so many samples ahead
  double structure = 0.0;    ///< of the residuals: correlation in time, standard deviations
  bool white = true;         ///< no significant structure, of samples that would show it
  Adequate residuals = Adequate::Undetermined;  ///< whether nothing but noise is left
  double chance = 1.0;       ///< probability of structure like this where the model is right
  double power = 0.0;        ///< probability that structure as large as the noise is seen
  std::string sign = {};     ///< what shows structure: "trend", "runs", ...
  std::vector<double> rmse_per_record = {};
  std::optional<NoiseLaw> law = {};  ///< with its sizes, where the model has one
  Index sizes = 1;                   ///< of the noise that were estimated
  Index censored = 0;                ///< values that are limits only
};

/// Free runs of held-out records: initial states from their first samples, the rest simulated.
struct FitGap {
  double before = 0.0, after = 0.0;  ///< rms over the channels of rmse / spread
  double noise_floor = 0.0;          ///< the same of the noise that the samples show
  std::vector<std::string> records;
  std::vector<FitQuality> channels;  ///< with the fitted model
};

/// Numbers that the records determine only together.
struct FitCombination {
  std::vector<std::string> members;
  std::string message;  ///< "k1 and k4 only as k1*k4"
};

/// How much worse the records are met while a number is held and all others are fitted to it.
struct FitProfile {
  std::string name;
  std::vector<double> values, deviance;  ///< values rising; 0 at the estimate
  double limit = 0.0;                    ///< deviance at the ends of the 95 % interval
};

/// A record beside the free run of the fitted model.
struct FitRun {
  std::string record;
  Vector time;             ///< n
  Matrix measured, model;  ///< n x channels; NaN where there is no value
  Matrix log_likelihood = {};  ///< n x channels; NaN where there is no value
};

/// What is known of the numbers of a fit together.
struct NumberSpread {
  /// P x P in the order of Fit::numbers: by the information, or by the gradients of blocks; 0
  /// for a number that stands at an end of its range or that each record has for itself.
  Matrix covariance;
  /// P x d: directions in which the numbers may move without a change of the free run.
  Matrix open;
};

/// Pointwise 90 % bands of a run of a fitted model. With J the derivatives of a quantity y by the
/// numbers and the initial values, and C their covariance, the standard error of y is the root
/// of J C J' (delta method; Seber and Wild, Nonlinear Regression (1989), Sect. 5.1), and bands
/// are q = t_0.95 of them wide on each side. A measured value adds the law of the noise.
struct FitBands {
  std::string record;
  Vector time;                       ///< n
  std::vector<Quantity> quantities;  ///< q: the states, then outputs of other names
  Matrix value;                      ///< n x q: the run
  Matrix error;      ///< n x q: standard error of it; NaN where it is not determined
  Matrix low, high;  ///< n x q: 90 % band of the run
  /// n x q: 90 % of the values that would be measured; NaN where the noise is not known.
  Matrix least, most;
};

/// What the likelihood is where parameters vary over records: that of the population, the
/// individual values integrated out.
struct FitPopulation {
  std::vector<double> log_likelihood;  ///< of each record
  std::vector<double> deviations;      ///< of each channel's noise; NaN where it has a law
  double unknowns = 0.0;  ///< numbers, spreads, sizes of noise, free initial values
  double aicc = 0.0;      ///< Hurvich and Tsai, Biometrika 76:297-307 (1989)
  double bic = 0.0;       ///< Schwarz, Annals of Statistics 6:461-464 (1978)
};

/// A model fitted to records.
struct Fit {
  SystemModel model;  ///< with estimates and their intervals
  std::vector<FittedParameter> numbers = {};
  std::vector<FitCorrelation> correlations = {};       ///< above 0.9
  std::vector<std::vector<FittedStart>> initial = {};  ///< per record
  std::vector<std::string> records = {};
  std::vector<FitQuality> quality = {};
  Adequacy adequacy = {};          ///< of the free run, by channels
  std::optional<FitGap> gap = {};  ///< where samples of held-out records could be compared
  std::vector<FitCombination> combinations = {};  ///< empty: all numbers are determined
  std::vector<FitProfile> profiles = {};          ///< where they were wanted
  bool converged = true;
  int starts = 1, agreeing = 1;  ///< from how many starts, how many came to the best
  /// Steps of integration in a sampling interval; 0: implicit ones, for a stiff model.
  Index substeps = 1;
  Index prediction = 10;  ///< samples ahead of FitQuality::prediction
  double degrees_of_freedom = 0.0;
  /// Of all values, with the estimated sizes of the noise; of the population where there is one.
  double log_likelihood = 0.0;
  std::vector<StageDone> stages = {};  ///< "fit", "starts", "profiles"
  std::vector<std::string> notes = {};
  std::vector<FitRun> runs = {};  ///< one for each record
  std::optional<FitPopulation> population = {};  ///< where parameters vary over records
  NumberSpread spread = {};            ///< empty where parameters vary over records
  std::vector<FitBands> bands = {};    ///< of each record, where they were wanted
  std::vector<FitBands> predicted = {};  ///< of records that chose nothing (predict())
};

/// What a fit may be relied on for; headline and verdict are made of it.
struct FitStanding {
  bool converged = true;
  Adequate fits = Adequate::Undetermined;  ///< whether the free run leaves nothing but noise
  std::size_t numbers = 0;           ///< that were fitted
  std::vector<std::string> open = {};     ///< those that the records do not determine
  std::vector<std::string> at_ends = {};  ///< those that ended at the end of their range
  bool is_exact = false;             ///< residuals are rounding, no noise can be seen
  Admission admission = {};  ///< whether it may be said that the model fits, or lacks something

  /// Whether residuals are noise, every number is determined, none stands at an end of its
  /// range, and nothing was left out that could change this.
  bool is_sound() const {
    return converged && fits == Adequate::Yes && open.empty() && at_ends.empty() &&
           admission.stands();
  }
};

/// How a fit stands: whether it converged and describes the records, and which of its parameters
/// are not determined or at the end of their range.
FitStanding standing_of(const Fit& fit);

/// One sentence on it.
std::string sentence_of(const FitStanding& standing);

/// Fits free coefficients and parameters of a model, and the initial states, to records by the
/// largest likelihood of a free run: the least sum of squares of measured minus model, each
/// channel divided by the deviation of its residuals, or the law of noise that its output has
/// (Output::noise), the sizes of which are estimated unless they are given. Events restart the
/// integration; derivatives jump there (EventMaps). Terms marked fixed, identities (dq/dt =
/// v) and fixed parameters stay; free parameters stay in their ranges. States need not be
/// measured. Standard errors are those of the Fisher information where residuals are white;
/// else they come from gradients of blocks of the records, which are correlated. The ends of an
/// interval are those of the profile of the likelihood, wherever it is asymmetric. A number
/// whose likelihood stays as high as far as the end of its range, or 1000 times the estimate,
/// has no interval but a limit on the other side. Numbers that the records determine in
/// combination only, or not at all, are named. What is known of a parameter before
/// (Parameter::deviation, of a normal distribution) is part of the likelihood.
/// Parameters on which delays depend are estimated outside of all others, by the profile of the
/// likelihood over their ranges.
/// What a deadline of the context ends is left out: other starts, then profiles.
/// Same input and seed, same result where no deadline came first.
/// @param data, held_out in the variables of the model, as of read_records().
/// @throws DataError when nothing is measured, when there are more unknowns than values, when
///   no free run is finite, and as check_are_others(); ModelError as
///   SystemModel::parametrised(); Cancelled.
Fit fit(const SystemModel& system, const Dataset& data, const Dataset& held_out,
        const FitOptions& options = {}, const RunContext& context = {});

/// Runs of a fitted model under other conditions, with bands.
/// @param conditions records in the variables of the model, as of read_conditions(): times and
///   inputs. Initial values are those of the first row, exact, where a state has a value there;
///   else those of the model, with its deviation. What else is measured is not looked at.
/// @throws ModelError where numbers belong to single records or vary over them; DataError for a
///   state without an initial value, and for a run that is not finite.
std::vector<FitBands> predict(const Fit& fit, const Dataset& conditions);

/// A fitted structure under its name.
struct NamedFit {
  std::string name;
  Fit fit;
};

/// How well one structure describes the records, beside the others.
struct FitRival {
  std::string name;
  double unknowns = 0.0;                ///< numbers, initial values and deviations of noise
  double log_likelihood = 0.0;          ///< of normal noise with one deviation for each channel
  double aicc = 0.0;                    ///< Hurvich and Tsai, Biometrika 76:297-307 (1989)
  double bic = 0.0;                     ///< Schwarz, Annals of Statistics 6:461-464 (1978)
  std::optional<double> held_out = {};  ///< FitGap::after
  Adequate fits = Adequate::Undetermined;
  bool converged = true;
  /// How much better the best one is by Vuong's test, in standard deviations; 0 for the best.
  double behind = 0.0;
  bool is_tied = true;  ///< whether the records do not distinguish it from the best
};

/// Structures that were fitted to the same records, the best (least AICc) first.
struct RivalComparison {
  std::vector<FitRival> rivals;
  double values = 0.0;  ///< that each was compared with, n
  /// What was noted at each of the fits, of the records then and no model.
  std::vector<std::string> notes = {};
};

/// Compares structures by the likelihood. With l_i the log-likelihood of a value, Vuong's
/// statistic is the sum of d = l_1 - l_2 over its deviation (Vuong, Econometrica 57:307-333,
/// 1989; that of Newey and West, Econometrica 55:703-708, 1987, because residuals of wrong
/// structures are correlated). Where parameters of one vary over records, l_i is that of a
/// record instead, and records are independent. Unknowns count in AICc, by which structures are
/// sorted: one with a term more that the records do not need has the same likelihood, and is
/// tied. A rival is tied with the best where AICc differs by no more than 2 (Burnham and
/// Anderson, Model Selection and Multimodel Inference (2002), Sect. 2.6), or Vuong's statistic
/// is below 1.96.
/// @throws ArgumentError for none; DataError where two have not the same values to meet.
RivalComparison compare_fits(const std::vector<NamedFit>& fits);

}  // namespace lacuna
