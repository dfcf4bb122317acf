// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "lacuna/identify/validation/sync_verdict.hpp"

namespace lacuna {

/// A synchronisation and what is needed to report it.
struct SyncReport {
  SyncResult result;
  std::vector<Quantity> states;  ///< of the model
  std::string time_unit;
  bool coupling_given = false;  ///< by the user; else taken from the record's own time scale
  std::string integrator;       ///< its registered name
  SyncVerdict verdict = {};     ///< whether the model holds on the record
};

/// For people: the errors, the coupling used and where it comes from, how it ended.
std::string format_text(const SyncReport& report);

/// JSON text of the format "lacuna.sync/1": median, mean, relative, settled, status, coupling.
std::string format_json(const SyncReport& report);

}  // namespace lacuna
