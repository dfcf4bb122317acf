// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "lacuna/identify/pipeline/pipeline.hpp"
#include "lacuna/report/pages/sync_report.hpp"

namespace lacuna {

/// An identification and all that is reported of it.
struct IdentificationReport {
  IdentificationResult result;
  Pipeline pipeline;                    ///< what was used
  std::string asked = "{}";             ///< the configuration asked for, JSON text
  std::optional<SyncReport> sync = {};  ///< the verification against the record
};

/// For people: equations, coefficients with their standard errors, fit, noise, which terms were
/// removed by what number, synchronisation, warnings. Numbers have the digits that their
/// intervals allow, all with `full`.
std::string format_text(const IdentificationReport& report, bool full = false);

/// JSON text of the format "lacuna.identification/1"; the same report gives the same bytes.
std::string format_json(const IdentificationReport& report);

}  // namespace lacuna
