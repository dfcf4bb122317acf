// SPDX-License-Identifier: MIT
// How a model is diagnosed.
#pragma once

#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/diagnose/criterion/criterion.hpp"
#include "lacuna/effects/effects.hpp"
#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/records/binding/gaps.hpp"
#include "lacuna/trajectories/smoother/noise_model.hpp"

namespace lacuna {

/// When a hint is given.
struct HintOptions {
  double slip_remainder = 0.2;
  double slip_misfit = 0.1;
  double slip_alike = 1.5;
  double slip_harm = 0.05;
  double slip_factor = 30.0;
  double round_factor = 0.02;
  double identity_factor = 2.0;
  double identity_match = 0.9;
  double column_fraction = 0.5;
  double column_own = 0.1;
  double column_rate = 0.05;
  double significance = 5.0;
  double feedback = 0.95;
  double samples_per_period = 8.0;
  double periods = 2.0;
  double barely_moving = 3.0;
  double alike_terms = 0.01;

  void describe(OptionVisitor& visitor);
};

/// By what records count as smoothed before they were written, and how far that is undone.
struct SmoothingOptions {
  int widest = 41;
  double below = 10.0;
  int turns = 30;
  double in_common = 0.1;
  int least_left = 50;

  void describe(OptionVisitor& visitor);
};

/// Every threshold by which a diagnosis decides. What each trades, and what changes at half and
/// at double its value, is in docs/decisions.md.
struct DecisionOptions {
  static constexpr StageInfo kInfo{"decision", "The thresholds of a diagnosis", ""};

  double significance = 3.0;
  double effect_size = 1e-3;
  double undecided = 10.0;
  int max_effects = 4;

  double negligible = 0.05;
  double minor = 0.1;
  double major = 0.5;

  double worth_shaping = 0.02;
  double worth_fitting = 0.05;
  double possible = 2.0;
  int rough_fits = 10;
  int exact_fits = 4;
  int start_fits = 6;

  double noise_inflation = 1.3;
  double longest_memory = 1.0 / 3.0;
  int long_window = 10;
  double outlying = kOutlyingDeviations;
  double pile_up = 5.0;

  double explained_gap = 1.5;
  double open_gap = 2.0;
  double least_closed = 0.9;
  double diverging = 1.0;
  double input_noise = 0.6;
  double cancelling = 0.1;
  double out_of_scale = 10.0;
  double rescaled = 2.0;
  double acting = 0.01;
  double filter_gain = 0.3;
  double dense_input = 0.5;

  GapOptions gaps = {};  ///< these four are listed with the others
  SmoothingOptions smoothing = {};
  NamingOptions naming = {};
  HintOptions hints = {};

  void describe(OptionVisitor& v);
};

/// Carrier of the thresholds where parts are looked up by name: `lacuna describe decision`.
class DecisionRules : public StageInterface {
 public:
  static constexpr std::string_view kKind = "decision";
};

/// The thresholds as a registered part.
class StandardDecision final : public Configured<DecisionRules, DecisionOptions> {
 public:
  using Configured::Configured;
};

class Hypothesis;

/// The hypotheses of lacuna in the order in which they are judged.
std::vector<Stage<Hypothesis>> standard_hypotheses();

/// How a model is diagnosed.
struct DiagnosisOptions {
  std::vector<Stage<Effect>> effects = standard_effects();  ///< that are tried; empty: none
  std::vector<CoefficientPrior> tolerances = {};            ///< of nominal coefficients
  std::vector<Stage<Hypothesis>> hypotheses = standard_hypotheses();  ///< that are judged
  Stage<Criterion> criterion = extended_bic();  ///< by which they are judged
  DecisionOptions decision = {};                ///< thresholds
  bool fill_gap = false;  ///< structure without a name gets a black-box residual function
  Thoroughness effort = Thoroughness::Normal;  ///< see diagnose()
};

}  // namespace lacuna
