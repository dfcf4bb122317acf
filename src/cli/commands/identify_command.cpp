// SPDX-License-Identifier: MIT
#include <chrono>
#include <memory>

#include "answers.hpp"
#include "cli/configuration/identification_configuration.hpp"
#include "cli/terminal/first_screen.hpp"
#include "command.hpp"
#include "core/base/text.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "data_options.hpp"
#include "lacuna/data/long_records.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "report/pages/data_summary.hpp"
#include "report/pages/pages.hpp"
#include "report_options.hpp"

namespace lacuna::cli {
namespace {

struct IdentifyArguments : IdentifyRequest {
  RunOptions run;
  std::optional<std::string> model_out, json;
  ReportOptions report;
  TextOptions text;
};

void declare_pipeline_options(Command& command, IdentifyArguments& options) {
  command.add("--preset NAME", &options.preset,
              "Composition of stages to start from: algorithm1, paper, robust, sindy "
              "[default: algorithm1]");
  command.add("--config FILE", &options.config,
              "JSON file that overrides the preset by stages");
  command.add("--degree D", &options.degree, "Monomials up to this degree [default: 3]")
      .exclude("--terms");
  command
      .add("--terms LIST", &options.terms, "Candidate terms outright, e.g. \"sign(q_d1),1,F\"")
      .exclude("--degree");
  command.add("--discrete", &options.discrete,
              "Find a map x[n+1] = f(x[n]) instead of a flow dx/dt = f(x)");
  command.add("--hidden N", &options.hidden,
              "States that nobody measured: 1, found by the derivative of a measured one");
  command.add("--add LIST", &options.added,
              "Terms beside the library, e.g. \"sin(th),w*abs(w)\"");
  command.add("--fix,--constraint STATE:TERM=VALUE", &options.constraints,
              "What coefficients satisfy: \"dth: w = 1\", \"y: x*z, z: x*y = 0\" (the sum), "
              "\"y: x < 0\" (a sign), energy-preserving; repeatable");
  command.add("--equation STATE:LIST", &options.equations,
              "The terms of one equation, e.g. \"dw: sin(th), w, u\"; repeatable");
  command.add(
      "--dead-time INPUT=TIME", &options.dead_times,
      "How late an input acts, in the time unit of the records: auto (sought), 0, 0.02; "
      "repeatable [default: auto]");
  command
      .add("--alternatives N", &options.alternatives,
           "List so many models of other structure that the record cannot distinguish "
           "from the best, with criterion and held-out error")
      .check(from_to(1, 1000));
  command.add("--set PATH=VALUE", &options.assignments,
              "One value of the configuration, e.g. regressor.threshold=0.05 or "
              "validation.resolution=1e-4 (see `describe validation`); repeatable");
}

void declare_output_options(Command& command, IdentifyArguments& options) {
  command.add("--model-out FILE|-", &options.model_out,
              "Save the model (lacuna.model/1); - for standard output");
  command.add("--json FILE|-", &options.json,
              "Write the whole result as JSON; - for standard output");
  declare_report_options(command, options.report);
  command.add("--explain", &options.text.explain,
              "Show how the answer came about: fits, noise, removed terms, relations, all "
              "warnings");
  declare_digits_option(command, options.text.digits);
  command.add("--integrator NAME", &options.integrator, "Method of the verification")
      .show_default();
}

Configuration make_configuration(const IdentifyRequest& request) {
  Configuration configuration;
  if (request.config) configuration.merge_file(*request.config);
  if (request.config_text) configuration.merge_text(*request.config_text, "configuration");
  if (request.preset) configuration.set_preset(*request.preset);
  if (request.discrete) configuration.set_discrete();
  if (request.degree) configuration.set_degree(*request.degree);
  if (request.terms) configuration.set_terms(*request.terms);
  for (const std::string& text : request.constraints) configuration.add_constraint(text);
  if (!request.added.empty()) configuration.add_terms(join(request.added, ","));
  for (const std::string& equation : request.equations) configuration.set_equation(equation);
  for (const std::string& assignment : request.assignments) configuration.set(assignment);
  return configuration;
}

Pipeline make_pipeline(const Registry& registry, const IdentifyRequest& request,
                       const Configuration& configuration) {
  Pipeline pipeline = configuration.build(registry);
  if (request.basis) pipeline.basis = *request.basis;
  if (request.regressor) pipeline.regressor = *request.regressor;
  return pipeline;
}

/// Dead times that are given, of "u=0.02"; those of inputs that say auto are sought.
std::vector<DeadTime> given_dead_times(const std::vector<std::string>& texts) {
  std::vector<DeadTime> given;
  for (const auto& [part, name, value] :
       read_assignments({"--dead-time", "INPUT=TIME", "--dead-time u=0.02"}, texts)) {
    if (value == "auto") continue;
    const std::optional<double> time = parse_number(value);
    if (!time || !(*time >= 0.0))
      throw ConfigError("--dead-time " + part, "this is no time of at least 0",
                        "give auto, 0, or a time in the time unit of the records");
    given.push_back({name, *time});
  }
  return given;
}

IdentificationTask task_of(const Registry& registry, const IdentifyRequest& request,
                           const Configuration& configuration) {
  const bool as_given =
      configuration.says_pipeline() || request.basis.has_value() || request.regressor;
  IdentificationTask task{
      .pipeline = make_pipeline(registry, request, configuration),
      .library = as_given ? LibraryScope::AsGiven : LibraryScope::Extended,
      .measured = request.hidden ? Measured::AllButOne : Measured::AllStates,
      .effects = registry.make_all<Effect>(),
      .integrator = registry.make<Integrator>(request.integrator),
      .options = identification_options(configuration, registry)};
  task.options.effort = request.effort;
  task.options.dead_time.given = given_dead_times(request.dead_times);
  if (!request.held_out.empty())
    task.held_out = [&request](const OdeModel& model) {
      return records_for(model, request.held_out, common_roles(request.data),
                         FiniteDifferences{});
    };
  return task;
}

/// What was read, in a line.
std::string read_line(const RecordStream& records) {
  const Dataset& data = records.excerpt();
  std::string line = data_line(data, data.input_count());
  if (!records.is_long()) return line;
  const std::size_t count = records.records().size();
  return line + "; an excerpt of " + std::to_string(records.samples()) + " rows in " +
         std::to_string(count) + (count == 1 ? " record" : " records");
}

void write_results(const Session& session, const IdentifyArguments& options,
                   const IdentifyAnswer& answer) {
  const IdentificationReport& report = answer.report;
  if (options.model_out)
    write_output(session, *options.model_out,
                 model_text(*options.model_out, report.result.model, options.text.digits));
  if (options.json) write_output(session, *options.json, format_json(report));
  write_report(session, options.report,
               [&] { return identification_page(report, answer.records.excerpt()); });
  if (options.json != "-" && options.model_out != "-" && options.report.page != "-")
    show(session, text_of(answer, options.text));
}

/// Reads the data in the way that the options ask for.
Identification read_and_identify(const IdentifyRequest& options, const IdentificationTask& task,
                                 const RunContext& context) {
  const std::vector<EmbeddingOrder> orders = embedding_orders(options.data);
  const auto use = [&](RecordStream records) {
    return identify_records(std::move(records), task, context);
  };
  const RunContext reading = context.unhurried();
  reading.report("reading data", 0.0);
  const bool needs_all = options.hidden || !orders.empty();
  if (!needs_all && reads_in_pieces(options.data, options.memory))
    return with_stream(*open_records(options.data.paths, roles_in_pieces(options.data), reading,
                                     options.memory),
                       context, use);
  Dataset data = read_data(options.data);
  if (orders.empty()) return use(std::move(data));
  return use(embed(data, orders, *differentiator_of(*task.pipeline.formulation)));
}

/// Which choices do not show in the result, as the refiner finds terms and coefficients anew from
/// where they left off; empty where there is none.
std::string overridden_choices(const IdentificationTask& task,
                               const Configuration& configuration) {
  const std::string refiner(task.pipeline.refiner->info().name);
  std::vector<std::string> chosen;
  for (const char* kind : {"filter", "regressor", "pruner"})
    if (configuration.says(kind)) chosen.emplace_back(kind);
  if (chosen.empty() || refiner == "none") return "";
  return "the refiner `" + refiner +
         "` chooses terms and coefficients anew, so that the choice of " +
         join(chosen, ", ") +
         " seldom shows in the model: --set refiner=none shows it, `lacuna bench` compares parts";
}

/// Models of other structure, as long as there is time.
void add_alternatives(const IdentifyRequest& request, const IdentificationTask& task,
                      const RecordStream& records, IdentificationReport& report,
                      const RunContext& context) {
  if (!request.alternatives) return;
  run_stage(report.result.stages, kAlternativesStage, [&] {
    report.alternatives = find_alternatives(
        records, report.result, task.pipeline,
        {.count = static_cast<std::size_t>(*request.alternatives),
         .validation = task.options.validation},
        context);
  });
}

/// Options that one stage alone uses.
std::vector<AskedOption> asked_options(const IdentifyRequest& request,
                                       const Configuration& configuration,
                                       const IdentificationResult& result) {
  std::vector<AskedOption> asked;
  const auto ask = [&](bool given, const char* option, const char* stage) {
    if (given) asked.push_back({option, why_not(stage, result.stages)});
  };
  for (const auto& [key, stage] : {std::pair{"forms", kFormsStage},
                                   {"validation", kValidationStage},
                                   {"relations", kRelationsStage},
                                   {"advice", kAdviceStage},
                                   {"sync", kSynchronisationStage}})
    ask(configuration.says(key), key, stage);
  ask(request.integrator != IdentifyRequest{}.integrator, "--integrator",
      kSynchronisationStage);
  ask(!request.held_out.empty(), "--holdout", kValidationStage);
  ask(request.alternatives.has_value(), "--alternatives", kAlternativesStage);
  if (configuration.says("map") && result.model.is_map())
    asked.push_back({"map", "it says when the record of a flow looks like that of a map"});
  return asked;
}

void check_request(const IdentifyRequest& request) {
  if (request.hidden && *request.hidden != 1)
    throw ConfigError("--hidden", "only one hidden state can be identified",
                      "give 1, or measure more");
  if (request.discrete && (request.hidden || !embedding_orders(request.data).empty()))
    throw ConfigError("--discrete", "a map has no derivatives",
                      "leave out --hidden and --embed; earlier samples can be columns");
  if (request.hidden && !request.held_out.empty())
    throw ConfigError("--holdout", "the hidden state of other records is not known",
                      "leave it out, or use `lacuna fit MODEL DATA --holdout`");
}

/// Assignments of the command line that changed nothing of what is shown.
std::vector<AskedOption> idle_assignments(const Registry& registry,
                                          const IdentifyRequest& request,
                                          const IdentifyAnswer& found, const TextOptions& text,
                                          const RunContext& context) {
  return without_effect(request.assignments, format_text(found.report, text),
                        [&](const std::vector<std::string>& fewer) {
                          IdentifyRequest other = request;
                          other.assignments = fewer;
                          return format_text(answer(registry, other, context).report, text);
                        });
}

int identify_command(const Session& session, const IdentifyArguments& options) {
  check_open(options.report);
  RunContext context = make_context(session, options.run);
  FirstScreen screen(session.streams.err, session.begin);
  FirstAnswer first = nullptr;
  if (is_watched(session, options.run)) {
    context.progress = beside(screen, std::move(context.progress));
    first = [&](const IdentificationResult& result) {
      screen.take(first_answer_text(result, options.text));
    };
  }
  IdentifyRequest request = options;
  request.effort = options.run.effort;
  IdentifyAnswer found = answer(session.registry, request, context, std::move(first));
  if (options.text.explain)
    for (AskedOption& idle :
         idle_assignments(session.registry, request, found, options.text, context))
      found.asked.push_back(std::move(idle));
  if (!context.leads()) return 0;
  finish_progress(session, options.run);
  write_results(session, options, found);
  if (found.found()) return 0;
  session.streams.err << "lacuna: error: no equation was found: no candidate term explains a "
                         "derivative; try other terms (--degree, --terms) or --preset robust\n";
  return 1;
}

}  // namespace

bool IdentifyAnswer::found() const {
  const IdentificationResult& result = report.result;
  for (std::size_t k = 0; k < result.fit.size(); ++k)
    if (!result.fit[k].identity && !result.model.equations()[k].empty()) return true;
  return false;
}

IdentifyAnswer answer(const Registry& registry, const IdentifyRequest& request,
                      const RunContext& context, FirstAnswer first) {
  check_request(request);
  const Configuration configuration = make_configuration(request);
  IdentificationTask task = task_of(registry, request, configuration);
  task.first_answer = std::move(first);
  Identification found = read_and_identify(request, task, context);
  if (std::string note = overridden_choices(task, configuration); !note.empty())
    found.result.warnings.push_back(std::move(note));
  RecordStream records = found.records;
  IdentificationReport report =
      report_of(std::move(found), task.pipeline, configuration.text());
  if (context.leads()) add_alternatives(request, task, records, report, context.alone());
  std::vector<AskedOption> asked = asked_options(request, configuration, report.result);
  return {std::move(report), std::move(records), std::move(asked)};
}

std::string text_of(const IdentifyAnswer& answer, const TextOptions& options) {
  return read_line(answer.records) + "\n\n" + format_text(answer.report, options) +
         (options.explain ? unused_text(answer.asked) : "");
}

Command declare_identify() {
  auto options = std::make_shared<IdentifyArguments>();
  Command command{"identify", "Find the equations of motion in measured data and verify them"};
  command.add("DATA", &options->data.paths, "Files (text, .gz, .npy) or quoted patterns")
      .require();
  command.add("--holdout DATA", &options->held_out.paths,
              "Records to judge the model by [default: a quarter of DATA, in blocks]");
  declare_column_options(command, options->data, true);
  declare_pipeline_options(command, *options);
  declare_output_options(command, *options);
  command.add("--memory SIZE", bytes_in(options->memory),
              "Records that do not fit into so much are read in pieces, e.g. 300MB; "
              "those that are no .npy by way of a file in $TMPDIR [default: all are "
              "read into memory]");
  declare_run_options(command, options->run);
  declare_effort_options(command, options->run);
  command.run = [options](const Session& session) {
    return identify_command(session, *options);
  };
  return command;
}

}  // namespace lacuna::cli
