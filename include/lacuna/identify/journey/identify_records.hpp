// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "lacuna/effects/effects.hpp"
#include "lacuna/identify/options.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/identify/validation/sync_verdict.hpp"

namespace lacuna {

/// Which library a model is sought in.
enum class LibraryScope {
  Extended,  ///< that of the pipeline, and basis functions of effects beside it
  AsGiven,   ///< that of the pipeline and nothing else
};

/// What is measured of the system.
enum class Measured {
  AllStates,
  AllButOne,  ///< one state is reconstructed: identify_hidden()
};

/// What identify_records() is asked for.
struct IdentificationTask {
  Pipeline pipeline = algorithm1();
  LibraryScope library = LibraryScope::Extended;
  Measured measured = Measured::AllStates;
  std::vector<Stage<Effect>> effects = standard_effects();  ///< whose basis functions are tried
  Stage<Integrator> integrator = automatic();               ///< of the synchronisation
  IdentificationOptions options = {};

  /// Records to judge the model by, in its variables; without them a quarter of the samples is
  /// held out, in blocks.
  std::function<Dataset(const OdeModel& model)> held_out = nullptr;

  /// Is given the model of the regression while the other stages go on.
  FirstAnswer first_answer = nullptr;
};

/// How a model was driven by its own record, and whether it holds on it.
struct Verification {
  SyncResult result;
  SyncVerdict verdict;
  std::string integrator;  ///< its registered name
};

/// A model, how it came about, and what it is worth.
struct Identification {
  RecordStream records;  ///< what it was identified from, a reconstructed state included
  IdentificationResult result;
  std::optional<Verification> verification = {};  ///< none of a map, or with a warning
};

/// Names in IdentificationResult::stages besides those of identify().
inline constexpr const char* kFormsStage = "forms";
inline constexpr const char* kDeadTimesStage = "dead times";
inline constexpr const char* kPlainStructureStage = "plain structure";
inline constexpr const char* kValidationStage = "validation";
inline constexpr const char* kAdviceStage = "advice";
inline constexpr const char* kRelationsStage = "relations";
inline constexpr const char* kSynchronisationStage = "synchronisation";

/// The whole of identify: the pipeline finds equations, basis functions of effects enter where
/// the library is short of them, inputs act later than they are recorded where free runs are
/// better by that (IdentificationOptions::dead_time), the model is judged on samples that it
/// was not fitted to, a plain structure takes the place of one that does not predict where its
/// free runs are better, the model is driven by the record, and what it lacks is looked for.
/// What cannot be done for want of samples is a warning of the result. Each stage leaves a
/// whole answer. Past the deadline of the context those that are left do not come, and with
/// IdentificationOptions::effort quick neither do forms, advice and relations: `stages` of the
/// result lists them. A team divides the first run; members that do not lead get the equations
/// alone.
/// @param records states n x m and inputs n x p of each record, in their units.
/// @throws DataError, ArgumentError, ConfigError as identify(), identify_hidden(); Cancelled.
Identification identify_records(RecordStream records, const IdentificationTask& task = {},
                                const RunContext& context = {});

}  // namespace lacuna
