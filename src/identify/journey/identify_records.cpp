// SPDX-License-Identifier: MIT
#include "lacuna/identify/journey/identify_records.hpp"

#include <algorithm>
#include <utility>

#include "centred_library.hpp"
#include "data/records/known_noise.hpp"
#include "fitting_library.hpp"
#include "identify/dead_time/dead_time_search.hpp"
#include "identify/dead_time/delayed_inputs.hpp"
#include "identify/forms_beside/identify_with_forms.hpp"
#include "identify/hidden_state/identify_hidden.hpp"
#include "identify/pipeline/given_rates.hpp"
#include "identify/plain_structure/plain_equations.hpp"
#include "identify/validation/advice.hpp"
#include "identify/validation/validate.hpp"
#include "lacuna/core/base/error.hpp"
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

/// What records in memory show of their inputs: a flow's are held where they repeat samples,
/// and powers of an input with few values are no candidates.
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
  if (task.library == LibraryScope::Extended)
    task.pipeline = with_determined_terms(task.pipeline, *data,
                                          task.options.library.samples_per_term, notes);
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
    found.warnings.push_back(
        "synchronisation: steps that adapt got too small, fixed ones were "
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

/// The records by which a model is judged: an excerpt of long ones, all of a map.
const Dataset& judged_records(const Identification& found) {
  return found.result.model.is_map() ? *found.records.in_memory() : found.records.excerpt();
}

/// A model judged on samples that it was not fitted to.
/// @throws DataError where they are too few for that.
std::optional<Validation> validated(const IdentificationTask& task,
                                    std::optional<Dataset> held_out, Identification& found,
                                    const RunContext& context) {
  IdentificationResult& result = found.result;
  const bool is_map = result.model.is_map();
  const Dataset& data = judged_records(found);
  const KnownNoise noise =
      is_map ? std::nullopt : KnownNoise(found.records.noise(context.threads));
  std::optional<Validation> validation;
  run_stage(result.stages, kValidationStage, [&] {
    validation = validate({result, data, task.pipeline, std::move(held_out), noise},
                          task.options.validation, context);
  });
  return validation;
}

/// What else the data hold.
void look_further(const IdentificationTask& task, std::optional<Validation> validation,
                  Identification& found, const RunContext& context) {
  IdentificationResult& result = found.result;
  const bool is_map = result.model.is_map();
  const Dataset& data = judged_records(found);
  const KnownNoise noise =
      is_map ? std::nullopt : KnownNoise(found.records.noise(context.threads));
  if (validation && falls_short(*validation) && !is_map)
    run_unless_quick(task, result, kAdviceStage, [&] {
      validation->advice =
          advice_for({result, data, task.pipeline, task.effects, white_noise(*noise)},
                     task.options.advice, context);
    });
  if (validation) take_in(*std::move(validation), data, result);
  if (!is_map)
    run_unless_quick(task, result, kRelationsStage, [&] {
      result.relations = find_relations(data, task.options.relations, context, noise);
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

/// A task and the libraries that it began with.
struct Prepared {
  IdentificationTask task;
  Pipeline chosen;
  bool is_centred = false;
};

/// Equations, in plain terms.
Identification plain_equations(RecordStream records, const Prepared& prepared,
                               const RunContext& context) {
  const IdentificationTask& task = prepared.task;
  Identification found = find_equations(std::move(records), task, context);
  if (!context.leads()) return found;
  const RunContext alone = context.alone();
  IdentificationResult& result = found.result;
  if (prepared.is_centred)
    result = with_lower_terms(prepared.chosen, task.pipeline, found.records, std::move(result),
                              alone);
  else if (task.measured == Measured::AllStates)
    result = with_plain_terms(prepared.chosen, found.records, std::move(result), alone);
  return found;
}

/// Whether inputs of a task may act late.
bool may_act_late(const IdentificationTask& task, const RecordStream& records) {
  const Dataset* data = records.in_memory();
  return data != nullptr && data->input_count() > 0 && task.measured == Measured::AllStates &&
         task.pipeline.formulation->evolution() == Evolution::Flow &&
         (task.options.dead_time.longest > 0.0 || !task.options.dead_time.given.empty());
}

/// Equations in inputs that act late, with records of these, where they are better.
/// @return T of each input; none where all act at once.
Vector take_dead_times(const Prepared& prepared, Identification& found,
                       const RunContext& context) {
  const FindEquations find = [&](const Dataset& data) {
    IdentificationResult result =
        plain_equations(RecordStream(data), prepared, context.alone()).result;
    context.check_stop();
    return result;
  };
  Vector times;
  const auto search = [&] {
    const Dataset& data = *found.records.in_memory();
    auto late = equations_with_dead_times(
        data, prepared.task.pipeline, prepared.task.options.dead_time, found.result, find,
        {found.records.noise(context.threads),
         prepared.task.options.validation.noise_slack},
        context);
    if (!late) return;
    times = late->times;
    late->result.stages = std::move(found.result.stages);
    late->result.dead_times = std::move(late->found);
    found = {RecordStream(with_inputs_delayed(data, times, times.maxCoeff())),
             std::move(late->result)};
  };
  if (prepared.task.options.dead_time.given.empty())
    run_unless_quick(prepared.task, found.result, kDeadTimesStage, search);
  else
    run_stage(found.result.stages, kDeadTimesStage, search);
  return times;
}

/// A task whose records to judge by have inputs that act as late.
IdentificationTask with_held_out_delayed(IdentificationTask task, const Vector& times) {
  if (task.held_out)
    task.held_out = [read = task.held_out, times](const OdeModel& model) {
      return with_inputs_delayed(with_input_columns(read(model)), times, times.maxCoeff());
    };
  return task;
}

/// Whether equations may be plainer: they do not predict, or one of them has as many terms as
/// its affine law and is another one.
bool may_be_plainer(const Validation& validation, const IdentificationResult& result) {
  if (validation.verdict != ValidationVerdict::FitsToNoise) return true;
  if (result.library_alone) return false;
  const OdeModel& model = result.model;
  const std::size_t affine = 1 + model.states().size() + model.inputs().size();
  const auto is_affine = [](const WeightedTerm& summand) {
    return summand.term.name() == "1" || summand.term.variable().has_value();
  };
  return std::any_of(model.equations().begin(), model.equations().end(),
                     [&](const Equation& equation) {
                       return equation.size() >= affine &&
                              !std::all_of(equation.begin(), equation.end(), is_affine);
                     });
}

/// A plain structure in the place of equations that do not predict, where its free runs are
/// better.
/// @param fits whether they predict to the noise: then every significant term counts.
/// @param times T of each input, as it was found before; changed with the equations.
/// @return whether equations were replaced.
bool take_plain_structure(const Prepared& prepared, const RecordStream& recorded, bool fits,
                          Identification& found, Vector& times, const RunContext& context) {
  const Dataset* data = recorded.in_memory();
  if (data == nullptr || prepared.task.measured != Measured::AllStates ||
      prepared.task.library != LibraryScope::Extended || found.result.model.is_map() ||
      !free_runs_decide(*data) || (fits && has_given_rates(*data)))
    return false;
  bool is_taken = false;
  run_unless_quick(prepared.task, found.result, kPlainStructureStage, [&] {
    auto plain = plain_equations(
        *data, prepared.chosen, prepared.task.options.dead_time,
        {found.result, times, fits, prepared.task.options.plain_structure.least_gain},
        KnownNoise(recorded.noise(context.threads)), context);
    if (!plain) return;
    plain->result.stages = std::move(found.result.stages);
    plain->result.dead_times = std::move(plain->found);
    times = plain->times.size() > 0 && plain->times.maxCoeff() > 0.0 ? plain->times : Vector();
    found = {times.size() > 0
                 ? RecordStream(with_inputs_delayed(*data, times, times.maxCoeff()))
                 : recorded,
             std::move(plain->result)};
    is_taken = true;
  });
  return is_taken;
}

/// What equations are worth: on samples that they were not fitted to, and driven by the record.
void judge_equations(const Prepared& prepared, const RecordStream& recorded,
                     Identification& found, Vector& times, const RunContext& context) {
  const auto task = [&] {
    return times.size() > 0 ? with_held_out_delayed(prepared.task, times) : prepared.task;
  };
  const auto held_out = [&] {
    return held_out_records(task(), found.result.model, judged_records(found));
  };
  std::optional<Dataset> records = held_out();  // what is wrong with them is an error
  try {
    std::optional<Validation> validation =
        validated(task(), std::move(records), found, context);
    if (validation && may_be_plainer(*validation, found.result) &&
        take_plain_structure(prepared, recorded,
                             validation->verdict == ValidationVerdict::FitsToNoise, found,
                             times, context)) {
      std::erase_if(found.result.stages,
                    [](const StageDone& stage) { return stage.name == kValidationStage; });
      validation = validated(task(), held_out(), found, context);
    }
    look_further(task(), std::move(validation), found, context);
  } catch (const DataError& error) {
    found.result.warnings.push_back(std::string("not validated: ") + error.what());
  }
  try {
    if (!found.result.model.is_map())
      run_stage(found.result.stages, kSynchronisationStage, [&] {
        found.verification = verify(task(), found.result, found.records, context);
      });
  } catch (const DataError& error) {
    found.result.warnings.push_back(std::string("not verified by synchronisation: ") +
                                    error.what());
  }
}

}  // namespace

Identification identify_records(RecordStream records, const IdentificationTask& given,
                                const RunContext& context) {
  Prepared prepared{with_effort(given), given.pipeline};
  std::vector<std::string> notes, centred;
  records = with_inputs_as_shown(std::move(records), prepared.task, notes);
  prepared.chosen = prepared.task.pipeline;
  if (prepared.task.measured == Measured::AllStates)
    prepared.task.pipeline =
        with_centred_library(prepared.task.pipeline, records.excerpt(), centred);
  prepared.is_centred = !centred.empty();
  const bool may_be_late = may_act_late(prepared.task, records);
  if (!may_be_late && !given.options.dead_time.given.empty())
    throw ConfigError("dead time", "these records, or a map of them, cannot have one",
                      "give records with inputs that fit into memory, and look for a flow");
  Identification found = plain_equations(std::move(records), prepared, context);
  if (!context.leads()) return found;
  const RecordStream recorded = found.records;
  Vector times = may_be_late ? take_dead_times(prepared, found, context) : Vector();
  judge_equations(prepared, recorded, found, times, context.alone());
  IdentificationResult& result = found.result;
  for (const auto& sentences : {centred, notes})
    result.warnings.insert(result.warnings.begin(), sentences.begin(), sentences.end());
  result.trapping = trapping_region(result.model);
  const bool is_map = result.model.is_map();
  warn_of_records(prepared.task, result,
                  is_map ? *found.records.in_memory() : found.records.excerpt());
  found.records = recorded;
  if (times.size() > 0) result = with_delays_written(std::move(result), times);
  return found;
}

}  // namespace lacuna
