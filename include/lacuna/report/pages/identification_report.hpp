// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/identify/alternatives/alternatives.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"
#include "lacuna/report/pages/sync_report.hpp"
#include "lacuna/report/pages/text_options.hpp"

namespace lacuna {

struct Identification;

/// An identification and all that is reported of it.
struct IdentificationReport {
  IdentificationResult result;
  Pipeline pipeline;                    ///< what was used
  std::string asked = "{}";             ///< the configuration asked for, JSON text
  std::optional<SyncReport> sync = {};  ///< the verification against the record
  /// Models of other structure that the records cannot distinguish from it, where they were sought.
  std::optional<std::vector<AlternativeModel>> alternatives = {};
};

/// For people, on a screen of 80 x 40: the verdict, what it was tested on, equations with 95 %
/// intervals, at most two warnings. With `explain` also the coefficients one by one, fits, noise,
/// relations, which terms were removed by what number, synchronisation, all warnings.
std::string format_text(const IdentificationReport& report, const TextOptions& options = {});

/// What identify_records() found, as a report shows it.
/// @param pipeline of the task. @param asked the configuration asked for, JSON text.
IdentificationReport report_of(Identification found, Pipeline pipeline, std::string asked = "{}");

/// The same text of what identify_records() found.
std::string format_text(const Identification& found, const TextOptions& options = {});

/// For people who wait for the rest: the equations of a result that is being refined, in a few
/// lines that say so.
std::string first_answer_text(const IdentificationResult& result,
                              const TextOptions& options = {});

/// JSON text of the format "lacuna.identification/1"; the same report gives the same bytes.
std::string format_json(const IdentificationReport& report);

}  // namespace lacuna
