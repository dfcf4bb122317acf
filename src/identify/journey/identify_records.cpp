// SPDX-License-Identifier: MIT
#include "lacuna/identify/journey/identify_records.hpp"

#include <algorithm>
#include <utility>

#include "centred_library.hpp"
#include "data/records/known_noise.hpp"
#include "distinct_powers.hpp"
#include "lacuna/dynamics/integration/automatic.hpp"
#include "identify/forms_beside/identify_with_forms.hpp"
#include "identify/hidden_state/identify_hidden.hpp"
#include "identify/validation/validate.hpp"
#include "lower_terms.hpp"
#include "plain_terms.hpp"
#include "records/binding/other_records.hpp"
#include "records/channels/column_hints.hpp"
#include "records/channels/shown_holds.hpp"

namespace lacuna {
namespace {

constexpr const char* kHiddenName = "h1";

bool is_quick(const IdentificationTask& task) {
  return task.options.effort == Thoroughness::Quick;
}

/// A stage that a quick run leaves out.
template <class Work>
void run_unless_quick(const IdentificationTask& task, IdentificationResult& result,
                      const char* name, Work work) {
  if (is_quick(task))
    result.stages.push_back({name, false, kIsQuick});
  else
    run_stage(result.stages, name, work);
}

/// Basis functions that the library lacks, where it is short of them.
void add_forms(const RecordStream& records, const IdentificationTask& task,
               IdentificationResult& result, const RunContext& context) {
  std::vector<StageDone> stages = result.stages;
  run_unless_quick(task, result, kFormsStage, [&] {
    result = with_forms_beside(records, task.pipeline, task.effects, result, task.options.forms,
                               context);
  });
  stages.push_back(result.stages.back());
  result.stages = std::move(stages);
}

/// A task whose searches go as far as its effort asks for.
IdentificationTask with_effort(IdentificationTask task) {
  if (task.options.effort != Thoroughness::Full) return task;
  for (FormOptions* forms : {&task.options.forms, &task.options.advice.search})
    forms->worth_asking = 0.0;
  return task;
}

/// What records in memory show of their inputs: a flow's are held where they repeat samples, and
/// powers of an input with few values are no candidates.
/// @param notes gets a sentence for each such input.
RecordStream with_inputs_as_shown(RecordStream records, IdentificationTask& task,
                                  std::vector<std::string>& notes) {
  const Dataset* data = records.in_memory();
  if (data == nullptr || task.measured != Measured::AllStates) return records;
  // Records of another form are an error of identify().
  const auto has_inputs = [&](const Trajectory& record) {
    return record.inputs.cols() == data->input_count();
  };
  if (!std::all_of(data->trajectories.begin(), data->trajectories.end(), has_inputs))
    return records;
  task.pipeline = with_distinct_powers(task.pipeline, *data, notes);
  const bool is_flow = task.pipeline.formulation->evolution() == Evolution::Flow;
  auto held = is_flow ? with_shown_holds(*data) : std::nullopt;
  return held ? RecordStream(*std::move(held)) : records;
}

Identification find_equations(RecordStream records, const IdentificationTask& task,
                              const RunContext& context) {
  const Pipeline& pipeline = task.pipeline;
  if (task.measured == Measured::AllButOne) {
    HiddenIdentification found = identify_hidden(*records.in_memory(), pipeline,
                                                 *differentiator_of(*pipeline.formulation),
                                                 kHiddenName, context.alone());
    return {std::move(found.data), std::move(found.result)};
  }
  IdentificationResult result = identify(records, pipeline, context, task.first_answer);
  if (task.library == LibraryScope::Extended && context.leads())
    add_forms(records, task, result, context.alone());
  return {std::move(records), std::move(result)};
}

/// By which slaves were integrated in the end.
const StageInfo& method_of(const SyncResult& sync, const Integrator& integrator) {
  if (sync.by_fixed_steps) return Rk4Options::kInfo;
  return sync.stiff ? AutomaticOptions::kInfo : integrator.info();
}

/// Drives a model with its record.
/// @throws DataError where the record is too short for that; OutOfTime.
std::optional<Verification> verify(const IdentificationTask& task, IdentificationResult& found,
                                   const RecordStream& records, const RunContext& context) {
  const Integrator& integrator = *task.integrator;
  const Dataset& data = records.excerpt();
  const Dataset driving = long_enough(data, integrator);
  SyncOptions options;
  if (driving.trajectories.size() < data.trajectories.size())
    found.warnings.push_back("synchronisation: " + driving.notes.back());
  else
    options.noise = white_noise(records.noise(context.threads));
  SyncResult sync = synchronise(found.model, driving, integrator, options, context);
  if (!left_out_line(sync.stages).empty()) throw OutOfTime();
  if (sync.status != IntegrationStatus::Completed)
    found.warnings.push_back("synchronisation with the record failed: " + sync.message);
  else if (!sync.settled)
    found.warnings.push_back("synchronisation with the record did not settle");
  SyncVerdict verdict =
      beside(found.adequacy, judge(found.model, driving, sync, task.options.sync));
  if (sync.by_fixed_steps)
    found.warnings.push_back("synchronisation: steps that adapt got too small, fixed ones were "
                             "taken (rk4)");
  const StageInfo& method = method_of(sync, integrator);
  return Verification{std::move(sync), std::move(verdict), std::string(method.name)};
}

/// @throws DataError where they are none of the model's, or those that it was identified from.
std::optional<Dataset> held_out_records(const IdentificationTask& task, const OdeModel& model,
                                        const Dataset& data) {
  if (!task.held_out) return std::nullopt;
  Dataset records = with_input_columns(task.held_out(model));
  records.rate_of = data.rate_of;
  check_are_others(data, records);
  return records;
}

bool falls_short(const Validation& validation) {
  return validation.verdict == ValidationVerdict::Approximation ||
         validation.verdict == ValidationVerdict::WrongLibrary;
}

/// Judges a model on samples that it was not fitted to, and looks for what else the data hold.
/// @throws DataError where they are too few for that.
void judge_model(const IdentificationTask& task, std::optional<Dataset> held_out,
                 IdentificationResult& found, const RecordStream& records,
                 const RunContext& context) {
  const bool is_map = found.model.is_map();
  const Dataset& data = is_map ? *records.in_memory() : records.excerpt();
  const KnownNoise noise = is_map ? std::nullopt : KnownNoise(records.noise(context.threads));
  std::optional<Validation> validation;
  run_stage(found.stages, kValidationStage, [&] {
    validation = validate({found, data, task.pipeline, std::move(held_out), noise},
                          task.options.validation, context);
  });
  if (validation && falls_short(*validation) && !is_map)
    run_unless_quick(task, found, kAdviceStage, [&] {
      validation->advice =
          advice_for({found, data, task.pipeline, task.effects, white_noise(*noise)},
                     task.options.advice, context);
    });
  if (validation) take_in(*std::move(validation), data, found);
  if (!is_map)
    run_unless_quick(task, found, kRelationsStage, [&] {
      found.relations = find_relations(data, task.options.relations, context, noise);
    });
}

/// What is odd about the records, ahead of all other warnings.
void warn_of_records(const IdentificationTask& task, IdentificationResult& found,
                     const Dataset& data) {
  found.warnings.insert(found.warnings.begin(), data.notes.begin(), data.notes.end());
  if (found.model.is_map()) return;
  for (const Hint& hint : column_hints(data))
    found.warnings.push_back(hint.message + "; try " + hint.remedy);
  if (const auto hint = map_hint(data, task.options.map))
    found.warnings.push_back(hint->message + "; try " + hint->remedy);
}

}  // namespace

Identification identify_records(RecordStream records, const IdentificationTask& given,
                                const RunContext& context) {
  IdentificationTask task = with_effort(given);
  std::vector<std::string> notes, centred;
  records = with_inputs_as_shown(std::move(records), task, notes);
  const Pipeline chosen = task.pipeline;
  if (task.measured == Measured::AllStates)
    task.pipeline = with_centred_library(task.pipeline, records.excerpt(), centred);
  Identification found = find_equations(std::move(records), task, context);
  if (!context.leads()) return found;
  const RunContext alone = context.alone();
  IdentificationResult& result = found.result;
  if (!centred.empty())
    result = with_lower_terms(chosen, task.pipeline, found.records, std::move(result),
                              alone);
  else if (task.measured == Measured::AllStates)
    result = with_plain_terms(chosen, found.records, std::move(result), alone);
  for (const auto& sentences : {notes, centred})
    result.warnings.insert(result.warnings.end(), sentences.begin(), sentences.end());
  result.trapping = trapping_region(result.model);
  const bool is_map = result.model.is_map();
  const Dataset& data = is_map ? *found.records.in_memory() : found.records.excerpt();
  warn_of_records(task, result, data);
  std::optional<Dataset> held_out = held_out_records(task, result.model, data);
  try {
    judge_model(task, std::move(held_out), result, found.records, alone);
  } catch (const DataError& error) {
    result.warnings.push_back(std::string("not validated: ") + error.what());
  }
  try {
    if (!is_map)
      run_stage(result.stages, kSynchronisationStage, [&] {
        found.verification = verify(task, result, found.records, alone);
      });
  } catch (const DataError& error) {
    result.warnings.push_back(std::string("not verified by synchronisation: ") + error.what());
  }
  return found;
}

}  // namespace lacuna
