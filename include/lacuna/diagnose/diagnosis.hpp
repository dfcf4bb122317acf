// SPDX-License-Identifier: MIT
// The answer of a diagnosis.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/model/equations/adequacy.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/records/channels/hint.hpp"
#include "lacuna/trajectories/smoother/noise_model.hpp"

namespace lacuna {

/// The answer in one word.
enum class Verdict {
  NoDiscrepancy,     ///< the nominal model fits to the noise
  CoefficientsOnly,  ///< no structure is missing, coefficients are off
  Explained,         ///< effects named, nothing significant left
  PartlyExplained,   ///< effects named, significant structure left
  UnnamedStructure,  ///< significant structure that no candidate explains
  Undetermined,      ///< the records allow neither what the search came to nor its opposite
  Incomplete,        ///< a limit cut the search, and a stage that it left out could change it
};

/// "no-discrepancy", "coefficients-only", "explained", "partly-explained", "unnamed-structure",
/// "undetermined", "incomplete".
std::string to_string(Verdict verdict);

/// A place where an equation and the records disagree.
struct Location {
  std::string variable;  ///< state, input or t; empty for a frequency
  double low = 0.0, high = 0.0;
  std::optional<double> frequency = {};  ///< per time unit
  double sigma = 0.0;
};

/// How far one equation and the records disagree.
struct Disagreement {
  Index equation = 0;
  double rms = 0.0;          ///< rate that has to be added to keep the model on the records
  double noise_floor = 0.0;  ///< the rate that would be significant by one standard deviation
  double sigma = 0.0;
  double fraction = 0.0;        ///< of all disagreement (drops of the deviance)
  double relative = 0.0;        ///< rms over that of the state's rate of change
  std::vector<Location> where;  ///< most significant first
};

/// Another effect that might be it.
struct Alternative {
  std::string name;
  std::string term;
  double probability = 0.0;
};

/// A shape parameter with its value.
struct NamedParameter {
  std::string name;
  std::string unit;
  double value = 0.0;
  std::optional<double> deviation = {};  ///< its standard error, where there is one
};

/// An effect that the nominal model lacks.
struct NamedEffect {
  Index equation = 0;
  Place place = Place::Rate;  ///< in the equation of the state, or in its measured value
  std::string name = {};
  std::string description = {};
  std::string cause = {};  ///< what usually causes it
  std::string term = {};
  double coefficient = 0.0;  ///< state unit (in an equation per time unit) per unit of the term
  double deviation = 0.0;    ///< standard error of the coefficient
  std::vector<NamedParameter> parameters = {};
  double sigma = 0.0;
  double gap_closed = 0.0;    ///< fraction of the disturbance's variance that goes with it
  double contribution = 0.0;  ///< rms of its rate over that of the state's rate
  double probability = 0.0;
  Index tried = 1;  ///< candidates and shapes that it was the best of
  std::vector<Alternative> alternatives = {};

  /// 95 % confidence interval of the coefficient.
  std::array<double, 2> ci95() const { return interval95(coefficient, deviation); }
};

/// One round of the search: what was tried and what came of it.
struct Round {
  Index tried = 0;
  std::string best;  ///< "coulomb-friction: sign(w) in dw/dt"; empty when nothing was found
  double sigma = 0.0;
  bool accepted = false;
};

/// What can be said of structure that no effect explains.
struct Unnamed {
  Index equation = 0;
  std::vector<std::string> variables;  ///< of which it is a function, as far as one is found
  double explained = 0.0;  ///< fraction of the disturbance's variance that goes with the curve
  bool memory = false;     ///< earlier values of the variables determine more than present ones
  bool periodic = false;   ///< a few lines of the spectrum make up most of it
  bool filled = false;     ///< a black-box function stands in the augmented model
  std::string formula = {};  ///< that says as much as the curve, where one does: "-12*sin(th)"
};

/// A composite model that was judged and what became of it: an entry of the trail.
struct Rival {
  std::string hypothesis;                ///< registered name: "coloured-noise"
  std::string composite;                 ///< what it says: "dw/dt: sign(w)"
  std::optional<double> criterion = {};  ///< its number; nothing where it was not fitted
  bool taken = false;
  std::string quantity = {};  ///< what was looked at: "extended-bic", "inflation of the noise"
  double value = 0.0;         ///< what it was
  double threshold = 0.0;     ///< what it was compared with
  std::string rule = {};      ///< what decided whatever the number; empty: the number did
};

/// Another explanation of the same records, which they do not distinguish from the one that was
/// taken.
struct Twin {
  std::string what;                     ///< names and places of its effects: twin_of()
  std::string sentence;                 ///< for people
  std::vector<std::string> names = {};  ///< of its effects
  bool measurement = false;             ///< whether a fault of a channel is among these
  std::string instead_of = {};          ///< the one effect in whose place it may be; empty: all
};

/// One record that the gap was measured on, with both models as they ran in its windows.
struct GapRecord {
  std::string source;
  Vector time;           ///< n
  Matrix measured;       ///< n x m, nominal states; NaN where a sample shows nothing
  Matrix before, after;  ///< n x m: nominal and augmented model; NaN where there is no window
  Index begin = 0;       ///< first sample of the first window
  Index length = 0;      ///< samples of a window
};

/// How far a model goes from whole records when it runs freely.
struct RunApart {
  double apart = 0.0;     ///< rms of (measured - run) / standard deviation of the state
  double duration = 0.0;  ///< the longest time for which it was compared
};

/// How far records and model are apart, before and after.
struct Gap {
  std::string metric;
  double before = 0.0;       ///< nominal model as it was given
  double after = 0.0;        ///< augmented model
  double noise_floor = 0.0;  ///< measurement noise alone
  /// By how many standard errors, from its scatter over the windows, `after`^2 is above
  /// floor^2.
  double above_floor = 0.0;
  double window = 0.0;  ///< length of the windows, time units
  std::vector<std::string> records;
  Index diverged = 0;  ///< windows in which a model has no finite solution; they do not count
  std::vector<GapRecord> runs = {};  ///< what the numbers are made of
  /// Of one run over each record as a whole; nothing where the models do not foretell
  /// themselves for the length of a window.
  std::optional<RunApart> free_before = {}, free_after = {};
  /// The floor without noise that has a memory, and `above_floor` of it.
  double white_floor = 0.0, above_white_floor = 0.0;

  /// after / before.
  double ratio() const noexcept { return before > 0.0 ? after / before : 1.0; }
};

/// A nominal coefficient and what the records show of it.
struct CoefficientChange {
  Index equation = 0;
  std::string term;
  double nominal = 0.0;
  double estimated = 0.0;
  double deviation = 0.0;
  double sigma = 0.0;
  /// Whether the records determine it; where states are hidden they may determine it with
  /// others only, and its deviation is none.
  bool determined = true;

  /// 95 % confidence interval of the estimate.
  std::array<double, 2> ci95() const { return interval95(estimated, deviation); }
};

/// Two coefficients of an equation that are off together, weighted, while the records do not
/// determine how much each is: first + weight * second.
struct CombinedChange {
  Index equation = 0;
  std::string first, second;  ///< their terms
  double weight = 0.0;
  double nominal = 0.0;  ///< of the combination
  double estimated = 0.0;
  double deviation = 0.0;
  double sigma = 0.0;  ///< of the best of all pairs

  /// 95 % confidence interval of the estimate.
  std::array<double, 2> ci95() const { return interval95(estimated, deviation); }
};

/// The residual structure in the end.
struct Remaining {
  bool structure = false;
  double sigma = 0.0;
  std::vector<Index> equations;            ///< with significant structure
  std::vector<EquationStructure> details;  ///< one for each of them
};

/// The least rate in an equation that would have been significant.
struct SmallestEffect {
  Index equation = 0;
  double rate = 0.0;
  double relative = 0.0;  ///< over the rms of the state's rate
};

/// What a nominal model lacks.
struct Diagnosis {
  Verdict verdict = Verdict::NoDiscrepancy;
  OdeModel nominal;
  std::vector<Disagreement> disagreement;
  std::vector<NamedEffect> effects;
  std::vector<CoefficientChange> coefficient_changes;
  std::optional<Gap> gap;
  Remaining remaining;
  OdeModel augmented;  ///< nominal model with fitted coefficients and all effects of the fit
  NoiseModel noise;
  std::vector<Round> rounds;
  std::vector<Rival> rivals;  ///< every composite model that was judged, in order
  std::vector<std::string> notes;
  std::optional<Unnamed> unnamed = {};  ///< with the verdict UnnamedStructure
  std::vector<Hint> hints = {};         ///< what is odd about the records, and its remedy
  Adequacy adequacy = {};  ///< of the augmented model, by equations of measured states
  std::vector<StageDone> stages = {};  ///< done, in order, and left out
  /// Whether the search's verdict may be given, and why not: `verdict` is Undetermined or
  /// Incomplete then, and effects are candidates without a claim.
  Admission admission = {};
  std::optional<CombinedChange> combined_change =
      {};                                             ///< where no coefficient is off by itself
  std::vector<SmallestEffect> smallest_effects = {};  ///< with the verdict Undetermined
  std::vector<Twin> twins = {};  ///< what explains the records as well as the effects
  std::vector<std::string> reservations = {};  ///< what else is against them, a phrase each
  /// Effects of the fit that each explain less than DecisionOptions::effect_size of the
  /// disagreement, beside `effects` that explain more: no part of what is named, and in
  /// `augmented`, which would be another fit without them.
  std::vector<NamedEffect> minor_effects = {};
};

}  // namespace lacuna
