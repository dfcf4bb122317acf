// SPDX-License-Identifier: MIT
// What an identification decides besides its pipeline.
#pragma once

#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"
#include "lacuna/model/invariants/relations.hpp"
#include "lacuna/records/channels/map_hint.hpp"

namespace lacuna {

/// By what functions that are no polynomials are sought, and when they are the answer. What
/// half and double of each changes is in docs/decisions.md.
struct FormOptions {
  static constexpr StageInfo kInfo{
      "forms", "When functions that are no polynomials stand beside a library or in its place",
      ""};

  double worth_asking = 1e-5;
  int most_forms = 3;
  int fewest_parameters = 3;
  double same = 0.1;
  double mostly_noise = 2.0;
  double significance = 4.0;

  int rough_fits = 100;
  int exact_fits = 6;
  int thinned = 60;
  double takes = 0.5;
  int denominators = 8;

  double alike = 0.99;
  double jump_samples = 0.15;
  double jump_far = 0.1;
  double jump_varies = 0.3;

  void describe(OptionVisitor& v);
};

/// How dead times of inputs are sought.
struct DeadTimeOptions {
  static constexpr StageInfo kInfo{"dead-time", "How dead times of inputs are sought", ""};

  double longest = 0.05;

  /// Inputs whose dead time is known; the time 0 of one that acts at once.
  std::vector<DeadTime> given = {};

  void describe(OptionVisitor& v);
};

/// Where the verdicts of a validation part, and what is held out for it. What half and double
/// of each changes is in docs/decisions.md.
struct ValidationOptions {
  static constexpr StageInfo kInfo{
      "validation", "What is held out of a record, and which errors are noise", ""};

  double noise_slack = 0.1;
  double scatter = 4.0;
  double structure = 2.0;
  double resolution = 2e-4;
  double small_fraction = 0.01;
  double wrong_fraction = 0.2;
  int least_freedom = 30;

  int held_every = 4;
  int blocks = 20;
  int fewest_blocks = 8;
  int most_samples = 6000;
  int least_windows = 10;
  int noise_samples = 100;
  int correlated_samples = 10;

  void describe(OptionVisitor& v);
};

/// Which forms are worth reporting where a model does not fit.
struct AdviceOptions {
  static constexpr StageInfo kInfo{"advice",
                                   "Which forms are reported where a model does not fit", ""};

  double worth_asking = 1e-3;
  double most_residual = 0.7;
  int most_forms = 2;
  FormOptions search = {};  ///< how forms are sought; listed as `forms`

  void describe(OptionVisitor& v) {
    v.field({"worth_asking", "",
             "Residual as a fraction of the rate (rms) below which an equation is not asked "
             "what it lacks.",
             0.0, 1.0},
            worth_asking);
    v.field(
        {"most_left", "",
         "A form that leaves a larger fraction of the residual (rms) is not what is missing.",
         0.0, 1.0},
        most_residual);
    v.field({"most_forms", "", "Forms that are reported for one equation at most.", 1.0, 20.0},
            most_forms);
  }
};

/// When a slave counts as being with the record. docs/decisions.md says what each trades.
struct SyncVerdictOptions {
  static constexpr StageInfo kInfo{"sync", "When a model holds on a record that drives it", ""};

  double above_noise = 2.0;
  double above_response = 1.25;
  double follows = 0.1;
  double resolution = 1e-4;
  int pieces = 40;
  double least_held = 0.1;
  double forgotten = 0.01;

  void describe(OptionVisitor& visitor);
};

/// How large a library of monomials may be.
struct LibraryOptions {
  static constexpr StageInfo kInfo{"library", "How large a library of monomials may be", ""};

  double samples_per_term = 2.0;

  void describe(OptionVisitor& v) {
    v.field({"samples_per_term", "",
             "Where records have fewer samples than this for each candidate term, monomials of "
             "the highest degrees are no candidates.",
             1.0},
            samples_per_term);
  }
};

/// How plain a structure is where nothing fits to the noise.
struct PlainStructureOptions {
  static constexpr StageInfo kInfo{"plain-structure",
                                   "What a term is worth where nothing fits to the noise", ""};

  double least_gain = 0.2;

  void describe(OptionVisitor& v) {
    v.field({"least_gain", "",
             "Where nothing fits to the noise each number of a structure has to take this "
             "fraction off what free runs without it leave (rms).",
             0.0, 1.0},
            least_gain);
  }
};

/// What identify_records() decides besides its pipeline.
struct IdentificationOptions {
  Thoroughness effort = Thoroughness::Normal;  ///< see identify_records()
  LibraryOptions library;
  FormOptions forms;
  DeadTimeOptions dead_time;
  PlainStructureOptions plain_structure;
  ValidationOptions validation;
  RelationOptions relations;
  AdviceOptions advice;  ///< seeks as `forms` says
  MapHintOptions map;
  SyncVerdictOptions sync;
};

}  // namespace lacuna
