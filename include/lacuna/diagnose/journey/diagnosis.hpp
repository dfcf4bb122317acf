// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/admission.hpp"
#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/diagnose/hints/hints.hpp"
#include "lacuna/diagnose/hypotheses/composite_model.hpp"
#include "lacuna/diagnose/journey/gap.hpp"
#include "lacuna/diagnose/journey/locate.hpp"
#include "lacuna/model/equations/adequacy.hpp"

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
  std::optional<CombinedChange> combined_change = {};  ///< where no coefficient is off by itself
  std::vector<SmallestEffect> smallest_effects = {};  ///< with the verdict Undetermined
  std::vector<Twin> twins = {};  ///< what explains the records as well as the effects
  std::vector<std::string> reservations = {};  ///< what else is against them, a phrase each
  /// Effects of the fit that each explain less than DecisionOptions::effect_size of the
  /// disagreement, beside `effects` that explain more: no part of what is named, and in
  /// `augmented`, which would be another fit without them.
  std::vector<NamedEffect> minor_effects = {};
};

}  // namespace lacuna
