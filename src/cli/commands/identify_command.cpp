// SPDX-License-Identifier: MIT
#include <memory>

#include "command.hpp"
#include "data_options.hpp"
#include "lacuna/cli/configuration/identification_configuration.hpp"
#include "lacuna/core/base/text.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/data/long_records/read_stream.hpp"
#include "lacuna/data/long_records/record_stream.hpp"
#include "lacuna/diagnose/hints/map_hint.hpp"
#include "lacuna/identify/forms_beside/identify_with_forms.hpp"
#include "lacuna/identify/hidden_state/identify_hidden.hpp"
#include "lacuna/identify/validation/validate.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/model/invariants/relations.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "lacuna/report/pages/data_summary.hpp"
#include "lacuna/report/pages/pages.hpp"
#include "report_options.hpp"

namespace lacuna::cli {
namespace {

struct IdentifyArguments {
  DataOptions data;
  RunOptions run;
  std::optional<std::string> preset, config, terms;
  std::optional<int> degree, hidden;
  std::vector<std::string> assignments, equations, added, constraints, held_out;
  std::optional<std::string> model_out, json;
  ReportOptions report;
  bool full = false, discrete = false;
  std::string integrator = "rk4";
  std::uint64_t memory = 0;  ///< bytes; 0: as much as there is
};

void declare_pipeline_options(CLI::App& app, IdentifyArguments& options) {
  app.add_option("--preset", options.preset,
                 "Composition of stages to start from: algorithm1, paper, robust, sindy "
                 "[default: algorithm1]")
      ->type_name("NAME");
  app.add_option("--config", options.config, "JSON file that overrides the preset by stages")
      ->type_name("FILE");
  app.add_option("--degree", options.degree, "Monomials up to this degree [default: 3]")
      ->type_name("D");
  app.add_option("--terms", options.terms, "Candidate terms outright, e.g. \"sign(q_d1),1,F\"")
      ->type_name("LIST");
  app.add_flag("--discrete", options.discrete,
               "Find a map x[n+1] = f(x[n]) instead of a flow dx/dt = f(x)");
  app.add_option("--hidden", options.hidden,
                 "States that nobody measured: 1, found by the derivative of a measured one")
      ->type_name("N");
  app.add_option("--add", options.added, "Terms beside the library, e.g. \"sin(th),w*abs(w)\"")
      ->type_name("LIST");
  app.add_option("--fix,--constraint", options.constraints,
                 "What coefficients satisfy: \"dth: w = 1\", \"y: x*z, z: x*y = 0\" (the sum), "
                 "energy-preserving; repeatable")
      ->type_name("STATE:TERM=VALUE");
  app.add_option("--equation", options.equations,
                 "The terms of one equation, e.g. \"dw: sin(th), w, u\"; repeatable")
      ->type_name("STATE:LIST");
  app.add_option("--set", options.assignments,
                 "One value of the configuration, e.g. regressor.threshold=0.05 or "
                 "validation.resolution=1e-4 (see `describe validation`); repeatable")
      ->type_name("PATH=VALUE");
}

void declare_output_options(CLI::App& app, IdentifyArguments& options) {
  app.add_option("--model-out", options.model_out,
                 "Save the model (lacuna.model/1); - for standard output")
      ->type_name("FILE|-");
  app.add_option("--json", options.json,
                 "Write the whole result as JSON; - for standard output")
      ->type_name("FILE|-");
  declare_report_options(app, options.report);
  app.add_flag("--full", options.full, "Show numbers with all their digits");
  app.add_option("--integrator", options.integrator, "Method of the verification")
      ->type_name("NAME")
      ->capture_default_str();
}

Configuration make_configuration(const IdentifyArguments& options) {
  Configuration configuration;
  if (options.config) configuration.merge_file(*options.config);
  if (options.preset) configuration.set_preset(*options.preset);
  if (options.discrete) configuration.set_discrete();
  if (options.degree) configuration.set_degree(*options.degree);
  if (options.terms) configuration.set_terms(*options.terms);
  for (const std::string& text : options.constraints) configuration.add_constraint(text);
  for (const std::string& terms : options.added) configuration.add_terms(terms);
  for (const std::string& equation : options.equations) configuration.set_equation(equation);
  for (const std::string& assignment : options.assignments) configuration.set(assignment);
  return configuration;
}

/// What is done with a record.
struct Plan {
  Pipeline pipeline;
  bool is_chosen;  ///< the user has said what the library is
  IdentificationOptions rules;
  std::vector<Stage<Effect>> effects;
};

/// Drives the model with the record itself, where it is a flow. Not being able to is a warning,
/// not a failure.
void verify(const Plan& plan, IdentificationReport& report, const Dataset& data,
            const Integrator& integrator, const RunContext& context) {
  if (report.result.model.is_map()) return;
  std::vector<std::string>& warnings = report.result.warnings;
  try {
    const Dataset driving = long_enough(data, integrator);
    if (driving.notes.size() > data.notes.size())
      warnings.push_back("synchronisation: " + driving.notes.back());
    SyncResult sync = synchronise(report.result.model, driving, integrator, {}, context);
    if (sync.status != IntegrationStatus::Completed)
      warnings.push_back("synchronisation with the record failed: " + sync.message);
    else if (!sync.settled)
      warnings.push_back("synchronisation with the record did not settle");
    SyncVerdict verdict = judge(report.result.model, driving, sync, plan.rules.sync);
    report.sync = SyncReport{std::move(sync),
                             data.states,
                             data.time_unit,
                             false,
                             std::string(integrator.info().name),
                             std::move(verdict)};
  } catch (const DataError& error) {
    warnings.push_back(std::string("not verified by synchronisation: ") + error.what());
  }
}

/// Records in the variables of a model, that were not identified from.
std::optional<Dataset> held_out_records(const IdentifyArguments& options, const OdeModel& model,
                                        const Dataset& data) {
  if (options.held_out.empty()) return std::nullopt;
  Dataset records =
      read_records(model, options.held_out, common_roles(options.data), FiniteDifferences{});
  records.rate_of = data.rate_of;
  return records;
}

Plan plan_of(const Session& session, const Configuration& configuration) {
  return {configuration.build(session.registry), configuration.says_pipeline(),
          identification_options(configuration, session.registry),
          session.registry.make_all<Effect>()};
}

/// Says what the model is worth, and what else the data say. Not being able to is a warning.
void judge_model(const Plan& plan, const IdentifyArguments& options, const Dataset& data,
                 IdentificationReport& report, const RunContext& context) {
  IdentificationResult& result = report.result;
  const ValidationTask task{result, data, report.pipeline,
                            held_out_records(options, result.model, data)};
  try {
    Validation validation = validate(task, plan.rules.validation, context);
    const bool lacks = validation.verdict == ValidationVerdict::Approximation ||
                       validation.verdict == ValidationVerdict::WrongLibrary;
    const bool is_map = result.model.is_map();
    if (lacks && !is_map)
      validation.advice = advice_for(result, data, plan.effects, plan.rules.advice, context);
    result.validation = std::move(validation);
    if (!is_map) result.relations = find_relations(data, plan.rules.relations, context);
  } catch (const DataError& error) {
    result.warnings.push_back(std::string("not validated: ") + error.what());
  }
}

bool found_a_model(const IdentificationResult& result) {
  for (std::size_t k = 0; k < result.fit.size(); ++k)
    if (!result.fit[k].identity && !result.model.equations()[k].empty()) return true;
  return false;
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
                   const IdentificationReport& report, const RecordStream& records) {
  if (options.model_out)
    write_output(session, *options.model_out,
                 format_model_for(*options.model_out, report.result.model));
  if (options.json) write_output(session, *options.json, format_json(report));
  write_report(session, options.report,
               [&] { return identification_page(report, records.excerpt()); });
  if (options.json != "-" && options.model_out != "-" && options.report.page != "-")
    show(session, read_line(records) + "\n\n" + format_text(report, options.full));
}

/// A result and the records from which it was found.
struct Identified {
  RecordStream records;
  IdentificationResult result;
};

/// Forms beside the library enter where the user has not said what the library is.
Identified identified(const Plan& plan, const IdentifyArguments& options, RecordStream records,
                      const RunContext& context) {
  const Pipeline& pipeline = plan.pipeline;
  if (options.hidden) {
    HiddenIdentification found =
        identify_hidden(*records.in_memory(), pipeline,
                        *differentiator_of(*pipeline.formulation), "h1", context.alone());
    return {std::move(found.data), std::move(found.result)};
  }
  IdentificationResult result =
      plan.is_chosen
          ? identify(records, pipeline, context)
          : identify_with_forms(records, pipeline, plan.effects, plan.rules.forms, context);
  return {std::move(records), std::move(result)};
}

/// Reads the data in the way that the options ask for.
Identified read_and_identify(const Plan& plan, const IdentifyArguments& options,
                             const RunContext& context) {
  const std::vector<EmbeddingOrder> orders = embedding_orders(options.data);
  const auto use = [&](RecordStream records) {
    return identified(plan, options, std::move(records), context);
  };
  context.report("reading data", 0.0);
  const bool needs_all = options.hidden || !orders.empty();
  if (!needs_all && reads_in_pieces(options.data, options.memory))
    return with_stream(*open_records(options.data.paths, roles_in_pieces(options.data), context,
                                     options.memory),
                       context, use);
  Dataset data = read_data(options.data);
  if (orders.empty()) return use(std::move(data));
  return use(embed(data, orders, *differentiator_of(*plan.pipeline.formulation)));
}

int identify_command(const Session& session, const IdentifyArguments& options) {
  std::vector<std::string> files = files_read(options.data, options.held_out);
  if (options.config) files.push_back(*options.config);
  check_outputs(files,
                with_report({{"--model-out", options.model_out}, {"--json", options.json}},
                            options.report));
  if (options.hidden && *options.hidden != 1)
    throw ConfigError("--hidden", "only one hidden state can be identified",
                      "give 1, or measure more");
  if (options.discrete && (options.hidden || !embedding_orders(options.data).empty()))
    throw ConfigError("--discrete", "a map has no derivatives",
                      "leave out --hidden and --embed; earlier samples can be columns");
  if (options.hidden && !options.held_out.empty())
    throw ConfigError("--holdout", "the hidden state of other records is not known",
                      "leave it out, or use `lacuna fit MODEL DATA --holdout`");
  const Configuration configuration = make_configuration(options);
  const Plan plan = plan_of(session, configuration);
  const auto integrator = session.registry.make<Integrator>(options.integrator);
  const RunContext divided = make_context(session, options.run);
  auto [records, result] = read_and_identify(plan, options, divided);
  IdentificationReport report{std::move(result), plan.pipeline, configuration.text()};
  if (!divided.leads()) return 0;
  const RunContext context = divided.alone();
  const bool is_map = report.result.model.is_map();
  const Dataset& data = is_map ? *records.in_memory() : records.excerpt();
  report.result.warnings.insert(report.result.warnings.begin(), data.notes.begin(),
                                data.notes.end());
  if (const auto hint = is_map ? std::nullopt : map_hint(data, plan.rules.map))
    report.result.warnings.push_back(hint->message + "; try " + hint->remedy);
  verify(plan, report, data, *integrator, context);
  judge_model(plan, options, data, report, context);
  finish_progress(session, options.run);
  write_results(session, options, report, records);
  if (found_a_model(report.result)) return 0;
  session.streams.err << "lacuna: error: no equation was found: no candidate term explains a "
                         "derivative; try other terms (--degree, --terms) or --preset robust\n";
  return 1;
}

}  // namespace

Command declare_identify(CLI::App& root) {
  auto options = std::make_shared<IdentifyArguments>();
  CLI::App* app = root.add_subcommand(
      "identify", "Find the equations of motion in measured data and verify them");
  app->add_option("DATA", options->data.paths, "Files (text, .gz, .npy) or quoted patterns")
      ->required();
  app->add_option("--holdout", options->held_out,
                  "Records to judge the model by [default: a quarter of DATA, in blocks]")
      ->type_name("DATA");
  declare_column_options(*app, options->data, true);
  declare_pipeline_options(*app, *options);
  declare_output_options(*app, *options);
  declare_size_option(*app, "--memory", options->memory,
                      "Records that do not fit into so much are read in pieces, e.g. 300MB; "
                      "those that are no .npy by way of a file in $TMPDIR [default: all are "
                      "read into memory]");
  declare_run_options(*app, options->run);
  return {app,
          [options](const Session& session) { return identify_command(session, *options); }};
}

}  // namespace lacuna::cli
