// SPDX-License-Identifier: MIT
#include <memory>

#include "cli/configuration/identification_configuration.hpp"
#include "command.hpp"
#include "core/base/text.hpp"
#include "data_options.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/data/long_records/read_stream.hpp"
#include "lacuna/data/long_records/record_stream.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "report/pages/data_summary.hpp"
#include "report/pages/pages.hpp"
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
  CLI::Option* degree =
      app.add_option("--degree", options.degree, "Monomials up to this degree [default: 3]")
          ->type_name("D");
  app.add_option("--terms", options.terms, "Candidate terms outright, e.g. \"sign(q_d1),1,F\"")
      ->type_name("LIST")
      ->excludes(degree);
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

IdentificationTask task_of(const Session& session, const IdentifyArguments& options,
                           const Configuration& configuration) {
  IdentificationTask task{
      .pipeline = configuration.build(session.registry),
      .library = configuration.says_pipeline() ? LibraryScope::AsGiven : LibraryScope::Extended,
      .measured = options.hidden ? Measured::AllButOne : Measured::AllStates,
      .effects = session.registry.make_all<Effect>(),
      .integrator = session.registry.make<Integrator>(options.integrator),
      .options = identification_options(configuration, session.registry)};
  if (!options.held_out.empty())
    task.held_out = [&options](const OdeModel& model) {
      return read_records(model, options.held_out, common_roles(options.data),
                          FiniteDifferences{});
    };
  return task;
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

/// Reads the data in the way that the options ask for.
Identification read_and_identify(const IdentifyArguments& options,
                                 const IdentificationTask& task, const RunContext& context) {
  const std::vector<EmbeddingOrder> orders = embedding_orders(options.data);
  const auto use = [&](RecordStream records) {
    return identify_records(std::move(records), task, context);
  };
  context.report("reading data", 0.0);
  const bool needs_all = options.hidden || !orders.empty();
  if (!needs_all && reads_in_pieces(options.data, options.memory))
    return with_stream(*open_records(options.data.paths, roles_in_pieces(options.data), context,
                                     options.memory),
                       context, use);
  Dataset data = read_data(options.data);
  if (orders.empty()) return use(std::move(data));
  return use(embed(data, orders, *differentiator_of(*task.pipeline.formulation)));
}

/// What is shown of an identification.
IdentificationReport report_of(Identification& found, const IdentificationTask& task,
                               const Configuration& configuration) {
  IdentificationReport report{std::move(found.result), task.pipeline, configuration.text()};
  if (found.verification) {
    const Dataset& data = found.records.excerpt();
    report.sync = SyncReport{std::move(found.verification->result),
                             data.states,
                             data.time_unit,
                             false,
                             std::move(found.verification->integrator),
                             std::move(found.verification->verdict)};
  }
  return report;
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
  const IdentificationTask task = task_of(session, options, configuration);
  const RunContext context = make_context(session, options.run);
  Identification found = read_and_identify(options, task, context);
  if (!context.leads()) return 0;
  const IdentificationReport report = report_of(found, task, configuration);
  finish_progress(session, options.run);
  write_results(session, options, report, found.records);
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
