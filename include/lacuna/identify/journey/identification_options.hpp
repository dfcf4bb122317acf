// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/identify/forms_beside/form_options.hpp"
#include "lacuna/identify/validation/advice.hpp"
#include "lacuna/identify/validation/sync_verdict.hpp"
#include "lacuna/identify/validation/validation_options.hpp"
#include "lacuna/model/invariants/relations.hpp"
#include "lacuna/records/channels/map_hint.hpp"

namespace lacuna {

/// What identify_records() decides besides its pipeline.
struct IdentificationOptions {
  Thoroughness effort = Thoroughness::Normal;  ///< see identify_records()
  FormOptions forms;
  ValidationOptions validation;
  RelationOptions relations;
  AdviceOptions advice;  ///< seeks as `forms` says
  MapHintOptions map;
  SyncVerdictOptions sync;
};

}  // namespace lacuna
