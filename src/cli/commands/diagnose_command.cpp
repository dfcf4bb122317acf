// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "answers.hpp"
#include "cli/configuration/diagnosis_configuration.hpp"
#include "command.hpp"
#include "core/base/json.hpp"
#include "core/base/parts.hpp"
#include "core/base/text.hpp"
#include "core/base/user_text.hpp"
#include "data_options.hpp"
#include "diagnose/journey/fitted_outputs.hpp"
#include "diagnose/journey/journey.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/model/equations/system_model.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "lacuna/report/reports.hpp"
#include "limit_options.hpp"
#include "report/pages/data_summary.hpp"
#include "report/pages/fleet_report.hpp"
#include "report/pages/pages.hpp"
#include "report_options.hpp"

namespace lacuna::cli {
namespace {

struct DiagnoseArguments : DiagnoseRequest {
  RunOptions run;
  bool explain = false, each = false;
  Digits digits = {};
  std::optional<std::string> json, model_out;
  ReportOptions report;
};

/// "w:sin(th)=5%" or "w:sin(th)=0.2": the standard deviation of a nominal coefficient.
CoefficientPrior parse_tolerance(const OdeModel& model, const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::size_t equals = text.rfind('=');
  if (colon == std::string::npos || equals == std::string::npos || equals < colon)
    throw ConfigError("--tolerance " + text, "this is not STATE:TERM=DEVIATION",
                      "write e.g. --tolerance 'w:sin(th)=5%'");
  const Index equation = model.state_index(text.substr(0, colon));
  const std::string name =
      Term::parse(text.substr(colon + 1, equals - colon - 1), model.variables()).name();
  std::string number = text.substr(equals + 1);
  const bool relative = !number.empty() && number.back() == '%';
  if (relative) number.pop_back();
  const auto value = parse_number(number);
  if (!value || !(*value > 0.0))
    throw ConfigError("--tolerance " + text, "the deviation is not a number above 0",
                      "write e.g. 5% or 0.2");
  const Equation& terms = model.equations()[static_cast<std::size_t>(equation)];
  for (std::size_t j = 0; j < terms.size(); ++j)
    if (terms[j].term.name() == name)
      return {{equation, static_cast<Index>(j)},
              terms[j].coefficient,
              relative ? 0.01 * *value * std::abs(terms[j].coefficient) : *value};
  throw ConfigError("--tolerance " + text, "the equation has no term " + name,
                    "name a term of the nominal model");
}

/// The request with the effort of the run.
DiagnoseRequest request_of(const DiagnoseArguments& options) {
  DiagnoseRequest request = options;
  request.effort = options.run.effort;
  return request;
}

Configuration configuration_of(const DiagnoseRequest& options) {
  Configuration configuration;
  if (options.config) configuration.merge_file(*options.config);
  if (!options.effects.empty())
    configuration.set_by("--effect", "effects", json_line(SortedJson(options.effects)));
  if (options.max_effects) {
    const std::string most = std::to_string(*options.max_effects);
    configuration.set_by("--max-effects " + most, "decision.max_effects", most);
  }
  if (options.fill_gap) configuration.set_by("--fill-gap", "fill_gap", "true");
  for (const std::string& assignment : options.assignments) configuration.set(assignment);
  return configuration;
}

DiagnosisOptions make_options(const Registry& registry, const OdeModel& model,
                              const DiagnoseRequest& options) {
  DiagnosisOptions result = diagnosis_options(configuration_of(options), registry);
  result.effects.insert(result.effects.end(), options.own_effects.begin(),
                        options.own_effects.end());
  for (const std::string& text : options.tolerances) {
    const CoefficientPrior next = parse_tolerance(model, text);
    for (std::size_t i = 0; i < result.tolerances.size(); ++i)
      if (result.tolerances[i].place == next.place)
        throw ConfigError("--tolerance " + text,
                          "it is given twice, first as '" + options.tolerances[i] + "'",
                          "keep one");
    result.tolerances.push_back(next);
  }
  result.effort = options.effort;
  return result;
}

/// A sample that one channel lacks says something of the others.
ColumnRoles roles_of(const DiagnoseRequest& options) {
  ColumnRoles roles = common_roles(options.data);
  roles.blanks = Blanks::Mark;
  return roles;
}

Dataset read_held_out(const OdeModel& model, const DiagnoseRequest& options,
                      const Differentiator& differentiator) {
  if (options.held_out.empty()) return {};
  return with_given_limits(
      records_for(model, options.held_out, roles_of(options), differentiator), options.limits);
}

/// Options that one stage alone uses, and those without which nothing would have been sought.
std::vector<AskedOption> asked_options(const DiagnoseRequest& request,
                                       const Diagnosis& diagnosis) {
  const Configuration configuration = configuration_of(request);
  std::vector<AskedOption> asked;
  const auto ask = [&](bool given, const char* option, const char* stage) {
    if (given) asked.push_back({option, why_not(stage, diagnosis.stages)});
  };
  for (const char* key : {"decision", "criterion"})
    ask(configuration.says(key), key, kCoefficientsStage);
  for (const char* key : {"effects", "hypotheses"})
    ask(configuration.says(key), key, kEffectsStage);
  ask(!request.tolerances.empty(), "--tolerance", kCoefficientsStage);
  ask(!request.held_out.empty(), "--holdout", kGapStage);
  if (configuration.says("fill_gap") && diagnosis.verdict == Verdict::Explained)
    asked.push_back({"fill_gap", "the effects leave nothing to fill"});
  return asked;
}

/// What is diagnosed, and how.
struct Asked {
  const Registry& registry;
  const SystemModel& model;
  const DiagnoseRequest& request;
};

/// What was found, and the augmented model in the parameters of the given one.
struct Found {
  Diagnosis diagnosis;
  SystemModel augmented;
};

/// The diagnosis of a model whose outputs have numbers that fit the records.
Found diagnosed(const Asked& asked, const Dataset& data, const Dataset& held_out,
                const RunContext& context) {
  const FittedOutputs fitted = with_fitted_outputs(asked.model, data, context);
  const OdeModel model = with_holds(fitted.model.model(), asked.request.data);
  Diagnosis found = diagnose(model, data, held_out,
                             make_options(asked.registry, model, asked.request), context);
  found.notes.insert(found.notes.begin(), fitted.notes.begin(), fitted.notes.end());
  SystemModel augmented = with_parameters_of(fitted.model, found.augmented);
  return {std::move(found), std::move(augmented)};
}

/// What a record shows by itself.
FleetAnswer answer_of(const std::string& file, const SystemModel& given,
                      const DiagnoseArguments& options, const Session& session,
                      const RunContext& context) {
  try {
    const OdeModel model = with_holds(given.model(), options.data);
    const auto differentiator = session.registry.make<Differentiator>(options.differentiator);
    const Dataset data = with_given_limits(
        read_records(model, {file}, roles_of(options), *differentiator, Columns::All),
        options.limits);
    const auto [diagnosis, augmented] =
        diagnosed({session.registry, given, request_of(options)}, data, {}, context);
    FleetAnswer answer = fleet_answer(file, diagnosis);
    answer.diagnosis = format_json(diagnosis, augmented);
    return answer;
  } catch (const Error& error) {
    return fleet_failure(file, user_text(error));
  }
}

/// Each record by itself; a team divides the records.
int diagnose_each(const Session& session, const DiagnoseArguments& options) {
  if (!options.held_out.empty() || options.model_out || options.report.page ||
      options.report.pictures)
    throw ConfigError("--each", "the answers are many",
                      "leave out --holdout, --model-out, --report and --plot");
  const SystemModel given = load_system(options.model);
  // What is wrong with the options is said once.
  make_options(session.registry, with_holds(given.model(), options.data), options);
  check_map(options.data, column_names(given.model()));
  const RunContext context = make_context(session, options.run);
  const std::vector<std::string> files = expand_patterns(options.data.paths);
  std::vector<std::string> texts(files.size());
  const OwnParts own = own_parts(files.size(), context);
  for (std::size_t i = own.first; i < own.end; ++i)
    texts[i] = packed(answer_of(files[i], given, options, session, context.alone()));
  exchange_texts(texts, context);
  if (!context.leads()) return 0;
  finish_progress(session, options.run);
  std::vector<FleetAnswer> fleet;
  for (const std::string& text : texts) fleet.push_back(unpacked(text));
  if (options.json) write_output(session, *options.json, format_json(fleet));
  if (options.json != "-") show(session, format_text(fleet));
  return 0;
}

/// What a diagnosis says, and the model with it.
std::string said(const DiagnoseAnswer& answer) {
  return format_text(answer.diagnosis) + to_text(answer.augmented.symbolic());
}

/// Assignments of the command line without each of which the same is said.
std::vector<AskedOption> idle_assignments(const Registry& registry,
                                          const DiagnoseRequest& request,
                                          const DiagnoseAnswer& found,
                                          const RunContext& context) {
  return without_effect(request.assignments, said(found),
                        [&](const std::vector<std::string>& fewer) {
                          DiagnoseRequest other = request;
                          other.assignments = fewer;
                          return said(answer(registry, other, context));
                        });
}

int diagnose_command(const Session& session, const DiagnoseArguments& options) {
  check_open(options.report);
  if (options.each) return diagnose_each(session, options);
  if (session.team != nullptr && session.team->rank() != 0) return 0;  // nothing is divided
  const DiagnoseRequest request = request_of(options);
  const RunContext context = make_context(session, options.run).alone();
  DiagnoseAnswer found = answer(session.registry, request, context);
  if (options.explain)
    for (AskedOption& idle : idle_assignments(session.registry, request, found, context))
      found.asked.push_back(std::move(idle));
  const Diagnosis& diagnosis = found.diagnosis;
  finish_progress(session, options.run);
  if (options.model_out)
    write_output(session, *options.model_out,
                 model_text(*options.model_out, found.augmented, options.digits));
  if (options.json)
    write_output(session, *options.json, format_json(diagnosis, found.augmented));
  write_report(session, options.report, [&] { return diagnosis_page(diagnosis); });
  if (options.json != "-" && options.model_out != "-" && options.report.page != "-") {
    show(session, text_of(found));
    if (options.explain) show(session, "\n" + explanation_of(found, options.digits));
  }
  return status_of(session, diagnosis.admission);
}

void declare_search_options(Command& command, DiagnoseArguments& options) {
  command.add("--effect NAME", &options.effects, "Try only these effects (see `list effect`)");
  command
      .add("--max-effects", &options.max_effects,
           "Name at most so many effects [default: " +
               std::to_string(DecisionOptions{}.max_effects) + "]")
      .check(from_to(0, 20));
  command.add("--config FILE", &options.config,
              "JSON file with decision, criterion, hypotheses, effects");
  command.add("--set PATH=VALUE", &options.assignments,
              "One value of the configuration, e.g. decision.significance=4; repeatable "
              "(see `describe decision`)");
  command.add("--explain", &options.explain,
              "Show the augmented model, and every composite model that was judged with the "
              "number that decided");
  declare_digits_option(command, options.digits);
  command.add("--fill-gap", &options.fill_gap,
              "Fit a spline or polynomials, as a stop-gap, to what the effects leave");
  command.add("--tolerance STATE:TERM=DEVIATION", &options.tolerances,
              "Standard deviation of a nominal coefficient, e.g. 'w:sin(th)=5%'");
}

}  // namespace

DiagnoseAnswer answer(const Registry& registry, const DiagnoseRequest& request,
                      const RunContext& context) {
  const SystemModel given = load_system(request.model);
  const OdeModel model = with_holds(given.model(), request.data);
  const auto differentiator = registry.make<Differentiator>(request.differentiator);
  check_map(request.data, column_names(model));
  context.unhurried().report("reading data", 0.0);
  const Dataset data = with_given_limits(
      records_for(model, request.data, roles_of(request), *differentiator, Columns::All),
      request.limits);
  const Dataset held_out = read_held_out(model, request, *differentiator);
  Found found = diagnosed({registry, given, request}, data, held_out, context);
  std::vector<AskedOption> asked = asked_options(request, found.diagnosis);
  return {std::move(found.diagnosis), std::move(found.augmented),
          data_line(data, static_cast<Index>(model.inputs().size())), std::move(asked)};
}

std::string text_of(const DiagnoseAnswer& answer) {
  return answer.read + "\n\n" + format_text(answer.diagnosis);
}

std::string explanation_of(const DiagnoseAnswer& answer, const Digits& digits) {
  return "Augmented model\n" + to_text(rounded(answer.diagnosis.augmented, digits).symbolic()) +
         "\n" + format_trail(answer.diagnosis) + unused_text(answer.asked);
}

Command declare_diagnose() {
  auto options = std::make_shared<DiagnoseArguments>();
  Command command{"diagnose", "Find what a nominal model lacks"};
  command.add("--model", &options->model.path, "Nominal model file").require();
  command.add("DATA", &options->data.paths, "Files (text, .gz, .npy) or quoted patterns")
      .require();
  command.add("--holdout DATA", &options->held_out.paths,
              "Records to gauge the gap on [default: the last quarter of the data]");
  declare_column_options(command, options->data, false);
  command.add("--limits q=LOW:HIGH", &options->limits,
              "Ends of the range of a channel, beyond which it shows the end; found by "
              "themselves where many samples are there");
  command.add("--each", &options->each,
              "Each file by itself: one table of answers, and how often each effect occurs");
  declare_search_options(command, *options);
  command
      .add("--differentiator NAME", &options->differentiator,
           "How states without a column are made from those that have one")
      .show_default();
  command.add("--model-out FILE|-", &options->model_out, "Write the augmented model");
  command.add("--json FILE|-", &options->json,
              "Write the diagnosis as JSON; - for standard output");
  declare_report_options(command, options->report);
  // Candidates are fitted side by side; all cores are in use unless set otherwise.
  options->run.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  declare_run_options(command, options->run);
  declare_effort_options(command, options->run);
  command.run = [options](const Session& session) {
    return diagnose_command(session, *options);
  };
  return command;
}

}  // namespace lacuna::cli
