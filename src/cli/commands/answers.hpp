// SPDX-License-Identifier: MIT
// What commands compute, apart from how they are asked and where they write: the command line
// and the Python package give the same answers to the same requests.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "data_options.hpp"
#include "lacuna/data/long_records.hpp"
#include "lacuna/diagnose/diagnosis.hpp"
#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/identify/bench/bench.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "lacuna/regression/stages/solvers.hpp"
#include "lacuna/report/reports.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "report/pages/data_summary.hpp"
#include "unused_options.hpp"

namespace lacuna::cli {

struct IdentifyRequest {
  DataOptions data = {};
  RecordSources held_out = {};
  std::optional<std::string> preset = {}, config = {}, terms = {};
  std::optional<std::string> config_text = {};  ///< JSON, said after the file `config`
  std::optional<int> degree = {}, hidden = {};
  std::optional<int> alternatives = {};  ///< models that are listed beside the best at most
  std::vector<std::string> assignments = {}, equations = {}, added = {}, constraints = {};
  std::vector<std::string> dead_times = {};  ///< "u=0.02", "v=auto"
  bool discrete = false;
  Thoroughness effort = Thoroughness::Normal;
  std::string integrator = "auto";
  std::uint64_t memory = 0;                        ///< bytes; 0: as much as there is
  std::optional<Stage<Basis>> basis = {};          ///< in no registry, for that of the pipeline
  std::optional<Stage<Regressor>> regressor = {};  ///< likewise
};

struct IdentifyAnswer {
  IdentificationReport report;
  RecordStream records;
  std::vector<AskedOption> asked = {};  ///< those of which it is known whether they were used

  /// Whether an equation was found that is no identity.
  bool found() const;
};

/// @param first as that of IdentificationTask.
/// @throws ConfigError for what does not go together, and as identify_records().
IdentifyAnswer answer(const Registry& registry, const IdentifyRequest& request,
                      const RunContext& context, FirstAnswer first = nullptr);

/// What was read in a line, and the identification.
std::string text_of(const IdentifyAnswer& answer, const TextOptions& options);

struct DiagnoseRequest {
  ModelSource model = {};
  DataOptions data = {};
  RecordSources held_out = {};
  std::vector<std::string> limits = {}, effects = {}, tolerances = {}, assignments = {};
  std::string differentiator = "finite-differences";
  std::optional<std::string> config = {};
  std::optional<int> max_effects = {};
  bool fill_gap = false;
  Thoroughness effort = Thoroughness::Normal;
  std::vector<Stage<Effect>> own_effects = {};  ///< in no registry, beside those of `effects`
};

struct DiagnoseAnswer {
  Diagnosis diagnosis;
  SystemModel augmented;  ///< that of the diagnosis, in the parameters of the given model
  std::string read = {};  ///< what was read, in a line
  std::vector<AskedOption> asked = {};  ///< those of which it is known whether they were used
};

/// @throws ConfigError as diagnosis_options(), and as read_records() and diagnose().
DiagnoseAnswer answer(const Registry& registry, const DiagnoseRequest& request,
                      const RunContext& context);

std::string text_of(const DiagnoseAnswer& answer);

/// The augmented model, every composite model that was judged, and options that decided
/// nothing.
std::string explanation_of(const DiagnoseAnswer& answer, const Digits& digits);

struct FitRequest {
  ModelSource model = {};
  DataOptions data = {};
  RecordSources held_out = {};
  RecordSources conditions = {};  ///< of runs that are predicted
  FitOptions fit = {};
};

/// The fit, and the predictions that were asked for.
/// @throws what read_records(), fit(), read_conditions() and predict() throw.
Fit answer(const FitRequest& request, const RunContext& context);

/// The same records fitted by several models, in the order given; a fit has the path of its model
/// for a name.
std::vector<NamedFit> answers(const FitRequest& request, const std::vector<ModelSource>& models,
                              const RunContext& context);

struct SyncRequest {
  ModelSource model = {};
  DataOptions data = {};
  std::string coupling = {};
  std::string integrator = "auto";
  std::string differentiator = "finite-differences";
};

struct SyncAnswer {
  SyncReport report;
  Dataset data;           ///< that of the model
  std::string read = {};  ///< what was read, in a line
};

/// @throws ConfigError for a coupling that is none, and as read_records() and synchronise().
SyncAnswer answer(const Registry& registry, const SyncRequest& request,
                  const RunContext& context);

/// What was read, notes, and the synchronisation.
std::string text_of(const SyncAnswer& answer);

/// Why the slave did not stay with the record; empty where it did.
std::string failure_of(const SyncAnswer& answer);

struct SimulateRequest {
  ModelSource model = {};
  DataOptions data = {};  ///< holds and names
  std::string x0 = {};
  std::optional<double> t_start = {};  // nothing: where the model or the inputs start, or 0
  std::optional<double> t_end = {};    // nothing: where the inputs end
  std::optional<double> step = {};     // nothing: the times of the inputs
  std::optional<Vector> times = {};  ///< in place of start, end and step
  RecordSources inputs = {};         ///< one
  std::optional<std::string> input_time = {};
  std::vector<std::string> noise = {};
  std::string integrator = "auto";
};

struct SimulateAnswer {
  Dataset data;  ///< states and, behind them, the outputs that are called otherwise; inputs
  std::vector<std::string> notes = {};  ///< on how inputs were read and where they end
  std::string problem = {};             ///< why there is no orbit; empty: there is
};

/// @throws ConfigError for a start, times or noise that are none, and as simulate().
SimulateAnswer answer(const Registry& registry, const SimulateRequest& request,
                      const RunContext& context);

struct CompareRequest {
  ModelSource model = {};    ///< the first of the two by a path, where it is no record
  RecordSources first = {};  ///< the first of the two in memory, where it is a record
  DataOptions data = {};
  std::string integrator = "auto";
  std::string differentiator = "finite-differences";
};

struct CompareAnswer {
  ComparisonReport report;
  std::string problem = {};  ///< why the model has no orbit; empty: there is a report
};

/// @throws ConfigError for more than two records, and as read_records() and
///   compare_attractors().
CompareAnswer answer(const Registry& registry, const CompareRequest& request,
                     const RunContext& context);

struct BenchRequest {
  DataOptions data = {};  ///< one path may be the name of a test system
  std::vector<std::string> parts = {};  ///< "regressor=ols,irls"
  std::vector<std::string> assignments = {};
  std::string noise = "0";  ///< percent of each state's deviation, with commas between them
  std::optional<std::string> preset = {}, config = {};
  std::optional<int> degree = {};
  int draws = 1, samples = 2000;
};

struct BenchAnswer {
  BenchResult result;
  std::string subject = {};   ///< what was identified
  bool has_refiner = false;   ///< whether the refiner is among what was compared

  /// Why no composition gave a model; empty where one did.
  std::string failure() const;
};

/// @throws ConfigError for parts or noise that are none, and as bench().
BenchAnswer answer(const Registry& registry, const BenchRequest& request,
                   const RunContext& context);

/// The tables, and a note where no refiner was compared.
std::string text_of(const BenchAnswer& answer);

struct CheckRequest {
  DataOptions data = {};
  std::optional<ModelSource> model = {};
  std::string differentiator = "finite-differences";
};

/// @throws what read_records() and look_at() throw.
DataSummary answer(const Registry& registry, const CheckRequest& request);

/// What `export` writes: names of formats, each with a line about it.
const std::map<std::string, std::string>& exports();

/// For people: the parts of a kind, each with what it does; of an empty kind all names by kind,
/// with how many there are.
/// @throws ConfigError when there is no such kind.
std::string list_of_parts(const Registry& registry, const std::string& kind);

/// All that has this name, for people. @throws ConfigError when nothing has.
std::string description_of(const Registry& registry, const std::string& name);

}  // namespace lacuna::cli
