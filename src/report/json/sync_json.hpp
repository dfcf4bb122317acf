// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "lacuna/report/reports.hpp"

namespace lacuna {

/// The synchronisation as a JSON object, without the name of the format.
nlohmann::ordered_json sync_to_json(const SyncReport& report);

}  // namespace lacuna
