// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/diagnose/criterion/smoothing_options.hpp"
#include "lacuna/diagnose/hints/hints.hpp"
#include "lacuna/forms/candidate/reading.hpp"
#include "lacuna/records/binding/gaps.hpp"

namespace lacuna {

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

}  // namespace lacuna
