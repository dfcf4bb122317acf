// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <memory>

#include "answers.hpp"
#include "command.hpp"
#include "data/units/in_units.hpp"
#include "data_options.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "lacuna/report/reports.hpp"
#include "records/channels/shown_holds.hpp"

namespace lacuna::cli {
namespace {

struct CompareArguments : CompareRequest {
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

CompareAnswer compare_model(const Registry& registry, const CompareRequest& options,
                            const RunContext& context) {
  const auto integrator = registry.make<Integrator>(options.integrator);
  const OdeModel model = with_holds(load_flow(options.model, "compare"), options.data);
  const auto differentiator = registry.make<Differentiator>(options.differentiator);
  check_map(options.data, column_names(model));
  const Dataset data =
      records_for(model, options.data, common_roles(options.data), *differentiator);
  Solution orbit = orbit_of(with_shown_holds(model, data), data, *integrator, context);
  if (orbit.status != IntegrationStatus::Completed) return {{}, orbit.message};
  Dataset simulated = data;
  simulated.trajectories = {longest_record(data)};
  simulated.trajectories[0].states = std::move(orbit.states);
  return {{options.model.path, options.data.name(),
           compare_attractors(simulated, data, context), data.notes}};
}

CompareAnswer compare_records(const CompareRequest& options, const RecordSources& one,
                              const RunContext& context) {
  const std::size_t others = std::max(options.data.paths.size(), options.data.tables.size());
  if (others != 1)
    throw ConfigError("compare", "two records are compared, not " + std::to_string(others + 1),
                      "name a model or a record, then one record");
  DataOptions first = options.data;
  static_cast<RecordSources&>(first) = one;
  const Dataset a = read_data(first), b = in_units_of(a.states, read_data(options.data));
  std::vector<std::string> notes = a.notes;
  notes.insert(notes.end(), b.notes.begin(), b.notes.end());
  return {
      {first.name(), options.data.name(), compare_attractors(a, b, context), std::move(notes)}};
}

int compare_command(const Session& session, const CompareArguments& options) {
  const CompareAnswer found =
      answer(session.registry, options, make_context(session, options.run));
  if (!found.problem.empty()) {
    session.streams.err << "lacuna: error: " << options.model.path << ": " << found.problem
                        << "; the model has no orbit as long as the record\n";
    return 1;
  }
  finish_progress(session, options.run);
  if (options.json) write_output(session, *options.json, format_json(found.report));
  if (options.json != "-") show(session, format_text(found.report));
  return status_of(session, found.report.admission());
}

}  // namespace

CompareAnswer answer(const Registry& registry, const CompareRequest& request,
                     const RunContext& context) {
  if (!request.first.empty()) return compare_records(request, request.first, context);
  if (request.model.given || is_model(request.model.path))
    return compare_model(registry, request, context);
  registry.make<Integrator>(request.integrator);  // a name that is none is said
  return compare_records(request, {.paths = {request.model.path}}, context);
}

Command declare_compare() {
  auto options = std::make_shared<CompareArguments>();
  Command command{"compare",
                  "Compare a model with a record, or two records, as orbits of an attractor"};
  command.add("FIRST", &options->model.path, "Model file, name of a test system, or a record")
      .require();
  command.add("DATA", &options->data.paths, "The other record").require();
  declare_column_options(command, options->data, true);
  command.add("--integrator NAME", &options->integrator, "Method; see `lacuna list integrator`")
      .show_default();
  command.add("--json FILE|-", &options->json,
              "Write the result as JSON; - for standard output");
  declare_run_options(command, options->run);
  declare_time_limit(command, options->run);
  command.run = [options](const Session& session) {
    return compare_command(session, *options);
  };
  return command;
}

}  // namespace lacuna::cli
