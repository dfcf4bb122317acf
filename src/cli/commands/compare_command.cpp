// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <memory>

#include "command.hpp"
#include "data_options.hpp"
#include "lacuna/dynamics/integration/record_input.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "lacuna/report/pages/comparison_report.hpp"
#include "records/channels/shown_holds.hpp"

namespace lacuna::cli {
namespace {

struct CompareArguments {
  std::string first;
  DataOptions data;
  std::string integrator = "dopri5";
  std::string differentiator = "finite-differences";
  std::optional<std::string> json;
  RunOptions run;
};

/// A model file by its ending, or a test system by its name.
bool is_model(const std::string& path) {
  const std::filesystem::path ending = std::filesystem::path(path).extension();
  if (ending == ".ode" || ending == ".json") return true;
  const auto& systems = test_systems();
  return !std::filesystem::exists(path) &&
         std::any_of(systems.begin(), systems.end(),
                     [&](const TestSystem& system) { return system.name == path; });
}

/// The orbit of the model from the first sample of the longest record, at its times.
Solution orbit_of(const OdeModel& model, const Dataset& data, const Integrator& integrator,
                  const RunContext& context) {
  const Trajectory& record = longest_record(data);
  const Vector start = record.states.row(0).transpose();
  if (model.inputs().empty()) return simulate(model, integrator, start, record.time, context);
  RecordInput inputs(record, model.inputs());
  return simulate(DrivenModel{model, inputs, inputs.breaks()}, integrator, start, record.time,
                  context);
}

int show_comparison(const Session& session, const CompareArguments& options,
                    const ComparisonReport& report) {
  finish_progress(session, options.run);
  if (options.json) write_output(session, *options.json, format_json(report));
  if (options.json != "-") show(session, format_text(report));
  return 0;
}

int compare_model(const Session& session, const CompareArguments& options,
                  const Integrator& integrator) {
  const OdeModel model = with_holds(load_flow(options.first, "compare"), options.data);
  const auto differentiator = session.registry.make<Differentiator>(options.differentiator);
  const RunContext context = make_context(session, options.run);
  const Dataset data =
      read_records(model, options.data.paths, common_roles(options.data), *differentiator);
  Solution orbit = orbit_of(with_shown_holds(model, data), data, integrator, context);
  if (orbit.status != IntegrationStatus::Completed) {
    session.streams.err << "lacuna: error: " << options.first << ": " << orbit.message
                        << "; the model has no orbit as long as the record\n";
    return 1;
  }
  Dataset simulated = data;
  simulated.trajectories = {longest_record(data)};
  simulated.trajectories[0].states = std::move(orbit.states);
  return show_comparison(
      session, options,
      {options.first, options.data.paths.front(), compare_attractors(simulated, data)});
}

int compare_records(const Session& session, const CompareArguments& options) {
  if (options.data.paths.size() != 1)
    throw ConfigError(
        "compare",
        "two records are compared, not " + std::to_string(options.data.paths.size() + 1),
        "name a model or a record, then one record");
  DataOptions first = options.data;
  first.paths = {options.first};
  const Dataset a = read_data(first), b = read_data(options.data);
  return show_comparison(session, options,
                         {options.first, options.data.paths.front(), compare_attractors(a, b)});
}

int compare_command(const Session& session, const CompareArguments& options) {
  check_outputs(files_read(options.data, {options.first}), {{"--json", options.json}});
  const auto integrator = session.registry.make<Integrator>(options.integrator);
  return is_model(options.first) ? compare_model(session, options, *integrator)
                                 : compare_records(session, options);
}

}  // namespace

Command declare_compare(CLI::App& root) {
  auto options = std::make_shared<CompareArguments>();
  CLI::App* app = root.add_subcommand(
      "compare", "Compare a model with a record, or two records, as orbits of an attractor");
  app->add_option("FIRST", options->first, "Model file, name of a test system, or a record")
      ->required();
  app->add_option("DATA", options->data.paths, "The other record")->required();
  declare_column_options(*app, options->data, true);
  app->add_option("--integrator", options->integrator, "Method; see `lacuna list integrator`")
      ->type_name("NAME")
      ->capture_default_str();
  app->add_option("--json", options->json, "Write the result as JSON; - for standard output")
      ->type_name("FILE|-");
  declare_run_options(*app, options->run);
  return {app,
          [options](const Session& session) { return compare_command(session, *options); }};
}

}  // namespace lacuna::cli
