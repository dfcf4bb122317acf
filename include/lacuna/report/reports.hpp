// SPDX-License-Identifier: MIT
// Answers as text for people and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/diagnose/diagnosis.hpp"
#include "lacuna/dynamics/attractor/comparison.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "lacuna/identify/alternatives/alternatives.hpp"
#include "lacuna/identify/bench/bench.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"
#include "lacuna/identify/validation/sync_verdict.hpp"
#include "lacuna/model/equations/rounding.hpp"
#include "lacuna/model/equations/system_model.hpp"
#include "lacuna/trajectories/design/plan.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {

/// How a result is shown as text.
struct TextOptions {
  Digits digits = {};    ///< of the numbers of a model
  bool explain = false;  ///< how the answer came about too, not only what fits on a screen
};

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

struct Identification;

/// An identification and all that is reported of it.
struct IdentificationReport {
  IdentificationResult result;
  Pipeline pipeline;                    ///< what was used
  std::string asked = "{}";             ///< the configuration asked for, JSON text
  std::optional<SyncReport> sync = {};  ///< the verification against the record
  /// Models of other structure that the records cannot distinguish from it, where they were
  /// sought.
  std::optional<std::vector<AlternativeModel>> alternatives = {};
};

/// For people, on a screen of 80 x 40: the verdict, what it was tested on, equations with 95 %
/// intervals, at most two warnings. With `explain` also the coefficients one by one, fits,
/// noise, relations, which terms were removed by what number, synchronisation, all warnings.
std::string format_text(const IdentificationReport& report, const TextOptions& options = {});

/// What identify_records() found, as a report shows it.
/// @param pipeline of the task. @param asked the configuration asked for, JSON text.
IdentificationReport report_of(Identification found, Pipeline pipeline,
                               std::string asked = "{}");

/// The same text of what identify_records() found.
std::string format_text(const Identification& found, const TextOptions& options = {});

/// For people who wait for the rest: the equations of a result that is being refined, in a few
/// lines that say so.
std::string first_answer_text(const IdentificationResult& result,
                              const TextOptions& options = {});

/// JSON text of the format "lacuna.identification/1"; the same report gives the same bytes.
std::string format_json(const IdentificationReport& report);

/// The answer for people, three to ten lines: verdict, each effect with numbers and units, what
/// the coefficients say, the gap on records not used, the residual.
std::string format_text(const Diagnosis& diagnosis);

/// Every composite model that was judged with the number or the rule that decided, for people.
std::string format_trail(const Diagnosis& diagnosis);

/// JSON text of the format "lacuna.diagnosis/1".
std::string format_json(const Diagnosis& diagnosis);

/// The same with the augmented model in other words, as with_parameters_of() has it.
std::string format_json(const Diagnosis& diagnosis, const SystemModel& augmented);

/// The fit for people: numbers with intervals, quality, what is not determined.
std::string format_text(const Fit& fit);

/// The fit as JSON of the format "lacuna.fit/1".
std::string format_json(const Fit& fit);

/// The comparison for people: a table, the best first, and what the records do not distinguish.
std::string format_text(const RivalComparison& comparison);

/// The comparison as JSON of the format "lacuna.rivals/1".
std::string format_json(const RivalComparison& comparison);

/// The comparison for people: for each noise a table of compositions, the best first (exact
/// structure, then error); failed draws below.
std::string format_text(const BenchResult& result);

/// Whether compositions are compared: not where a limit left out draws.
Admission admission_of(const BenchResult& result);

/// One line for each cell: parts, noise in %, draws, failed draws, rates and medians of what
/// BenchScore has, the first failure. Numbers that are not there are empty.
std::string format_csv(const BenchResult& result);

/// Two records, or a model's orbit and a record, beside one another.
struct ComparisonReport {
  std::string first, second;  ///< what was compared
  std::vector<AttractorMeasure> measures;
  std::vector<std::string> notes = {};  ///< of reading: units that were converted or were not

  /// Whether nothing disagrees, and something agrees.
  bool agree() const;

  /// Whether that may be said: a measure that a limit left out could change that nothing
  /// disagrees.
  Admission admission() const;
};

/// For people: each measure of both with its interval, and whether they agree.
std::string format_text(const ComparisonReport& report);

/// JSON text of the format "lacuna.comparison/1".
std::string format_json(const ComparisonReport& report);

/// What a plan is for, as it was asked.
struct PlanReport {
  PlanProblem problem;
  PlanOptions options;
  Plan plan;
};

/// The plan for people: what to run, what it is expected to decide, what it cannot and why.
std::string format_text(const PlanReport& report);

/// The plan as JSON of the format "lacuna.plan/1".
std::string format_json(const PlanReport& report);

/// How the inputs of a plan are written for a bench.
enum class InputFormat {
  Csv,  ///< columns of times and inputs; several runs are numbered in a column `trajectory`
  C,    ///< arrays of double
  Waveform,  ///< 16-bit text of arbitrary waveform generators, one input of one run
};

/// The inputs of a plan as text.
/// @throws ArgumentError for a waveform of more than one input, of several runs or of uneven
///   times.
std::string format_inputs(const PlanReport& report, InputFormat format);

}  // namespace lacuna
