// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/identify/dead_time/dead_time_options.hpp"
#include "lacuna/identify/forms_beside/form_options.hpp"
#include "lacuna/identify/validation/advice.hpp"
#include "lacuna/identify/validation/sync_verdict.hpp"
#include "lacuna/identify/validation/validation_options.hpp"
#include "lacuna/model/invariants/relations.hpp"
#include "lacuna/records/channels/map_hint.hpp"

namespace lacuna {

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
