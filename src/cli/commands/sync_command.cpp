// SPDX-License-Identifier: MIT
#include <memory>

#include "assignments.hpp"
#include "command.hpp"
#include "core/base/text.hpp"
#include "data_options.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "records/channels/shown_holds.hpp"
#include "report/pages/data_summary.hpp"
#include "report/pages/pages.hpp"
#include "report_options.hpp"

namespace lacuna::cli {
namespace {

struct SyncArguments {
  std::string model;
  DataOptions data;
  RunOptions run;
  std::string coupling;
  std::string integrator = "rk4";
  std::string differentiator = "finite-differences";
  std::optional<std::string> json;
  ReportOptions report;
};

/// K from "x=1,y=0.5": states that are not named are not coupled.
std::optional<Matrix> parse_coupling(const OdeModel& model, const std::string& text) {
  if (text.empty()) return std::nullopt;
  Matrix coupling = Matrix::Zero(model.dimension(), model.dimension());
  const std::string example = "--coupling x=1,y=0.5, in 1/" + model.time_unit();
  for (const auto& [part, name, value] :
       read_assignments({"--coupling", "NAME=NUMBER", example}, {text})) {
    const auto strength = parse_number(value);
    if (!strength || !std::isfinite(*strength))
      throw ConfigError("--coupling " + part, "this is not NAME=NUMBER",
                        "write e.g. " + example);
    const Index state = model.state_index(name);
    coupling(state, state) = *strength;
  }
  return coupling;
}

std::string notes_of(const Dataset& data, const SyncReport& report) {
  std::string lines;
  for (const std::string& note : data.notes) lines += "Note: " + note + "\n";
  if (report.result.stiff)
    lines +=
        "Note: the slave is faster than the samples: its steps between them were adapted\n";
  return lines;
}

int sync_command(const Session& session, const SyncArguments& options) {
  check_outputs(files_read(options.data, {options.model}),
                with_report({{"--json", options.json}}, options.report));
  const OdeModel model = with_holds(load_model(options.model), options.data);
  const auto integrator = session.registry.make<Integrator>(options.integrator);
  const auto differentiator = session.registry.make<Differentiator>(options.differentiator);
  const std::optional<Matrix> coupling = parse_coupling(model, options.coupling);
  const RunContext context = make_context(session, options.run);
  context.report("reading data", 0.0);
  const Dataset data = long_enough(
      read_records(model, options.data.paths, common_roles(options.data), *differentiator),
      *integrator);
  check_outputs_are_states(model, data);
  const OdeModel driven = with_shown_holds(model, data);
  SyncReport report{synchronise(driven, data, *integrator, {.coupling = coupling}, context),
                    model.states(), data.time_unit, coupling.has_value(), options.integrator};
  if (report.result.stiff) report.integrator = Dopri5Options::kInfo.name;
  report.verdict = judge(driven, data, report.result);
  finish_progress(session, options.run);
  if (options.json) write_output(session, *options.json, format_json(report));
  write_report(session, options.report, [&] { return sync_page(report, data); });
  if (options.json != "-" && options.report.page != "-")
    show(session, data_line(data, data.input_count()) + "\n" + notes_of(data, report) + "\n" +
                      format_text(report));
  if (report.result.status == IntegrationStatus::Completed) return 0;
  session.streams.err << "lacuna: error: " << report.result.message << "; try "
                      << stronger_coupling(model.states(), report.result.coupling) << "\n";
  return 1;
}

}  // namespace

Command declare_sync(CLI::App& root) {
  auto options = std::make_shared<SyncArguments>();
  CLI::App* app = root.add_subcommand(
      "sync", "Drive a model with a record and measure how far from it the model stays");
  app->add_option("MODEL", options->model, "Model file, or the name of a test system")
      ->required();
  app->add_option("DATA", options->data.paths, "Files (text, .gz, .npy) or quoted patterns")
      ->required();
  declare_column_options(*app, options->data, false);
  app->add_option("--coupling", options->coupling,
                  "Coupling of each named state, in 1/time unit [default: all states, from the "
                  "record's own time scale]")
      ->type_name("NAME=K,...");
  app->add_option("--integrator", options->integrator, "Method")
      ->type_name("NAME")
      ->capture_default_str();
  app->add_option("--differentiator", options->differentiator,
                  "How states without a column are made from those that have one")
      ->type_name("NAME")
      ->capture_default_str();
  app->add_option("--json", options->json, "Write the result as JSON; - for standard output")
      ->type_name("FILE|-");
  declare_report_options(*app, options->report);
  declare_run_options(*app, options->run);
  return {app, [options](const Session& session) { return sync_command(session, *options); }};
}

}  // namespace lacuna::cli
