// SPDX-License-Identifier: MIT
#include <memory>

#include "answers.hpp"
#include "command.hpp"
#include "data_options.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/gaps.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "lacuna/report/pages/fit_report.hpp"
#include "records/channels/shown_holds.hpp"
#include "report/pages/pages.hpp"
#include "report_options.hpp"

namespace lacuna::cli {
namespace {

/// What fits into no number is read as the largest one, which no record is as long as.
constexpr Index kMostSamples = Index{1} << 50U;

struct FitArguments : FitRequest {
  RunOptions run;
  std::optional<std::string> model_out, json;
  ReportOptions report;
};

/// A sample that one channel lacks says something of the others.
Dataset read(const OdeModel& model, const RecordSources& sources, const FitRequest& request) {
  ColumnRoles roles = common_roles(request.data);
  roles.blanks = Blanks::Mark;
  return usable_records(records_for(model, sources, roles, FiniteDifferences{}),
                        {.shortest_record = 4})
      .data;
}

/// The system with the holds of its inputs as given, and as the samples show them.
SystemModel with_all_holds(const SystemModel& system, const OdeModel& plain) {
  std::vector<std::optional<Hold>> holds;
  for (const Quantity& input : system.symbolic().inputs()) holds.push_back(input.hold);
  for (std::size_t i = 0; i < plain.inputs().size(); ++i) holds[i] = plain.inputs()[i].hold;
  return {system.symbolic().with_holds(holds), system.parameters()};
}

int fit_command(const Session& session, const FitArguments& options) {
  std::vector<std::string> files = files_read(options.data, options.held_out.paths);
  files.push_back(options.model.path);
  check_outputs(files,
                with_report({{"--model-out", options.model_out}, {"--json", options.json}},
                            options.report));
  const Fit found = answer(options, make_context(session, options.run));
  finish_progress(session, options.run);
  if (options.model_out)
    write_output(session, *options.model_out,
                 format_model_for(*options.model_out, found.model));
  if (options.json) write_output(session, *options.json, format_json(found));
  write_report(session, options.report, [&] { return fit_page(found); });
  if (options.json != "-" && options.model_out != "-" && options.report.page != "-")
    show(session, format_text(found));
  return found.converged ? 0 : 1;
}

}  // namespace

Fit answer(const FitRequest& request, const RunContext& context) {
  const SystemModel system = load_system(request.model);
  const OdeModel given = with_holds(system.model(), request.data);
  context.report("reading data", 0.0);
  const Dataset data = read(given, request.data, request);
  const Dataset held_out =
      request.held_out.empty() ? Dataset{} : read(given, request.held_out, request);
  const SystemModel held = with_all_holds(system, with_shown_holds(given, data));
  return fit(held, data, held_out, request.fit, context);
}

Command declare_fit(CLI::App& root) {
  auto options = std::make_shared<FitArguments>();
  CLI::App* app = root.add_subcommand(
      "fit", "Estimate the numbers of a model of known structure, hidden states too");
  app->add_option("MODEL", options->model.path, "Model file, or the name of a test system")
      ->required();
  app->add_option("DATA", options->data.paths, "Files (text, .gz, .npy) or quoted patterns")
      ->required();
  app->add_option("--holdout", options->held_out.paths, "Records to check the fit on")
      ->type_name("DATA");
  declare_column_options(*app, options->data, false);
  app->add_option("--start-samples", options->fit.window,
                  "First samples of a held-out record, which give its initial state")
      ->check(CLI::Range(Index{1}, kMostSamples))
      ->capture_default_str();
  app->add_option("--ahead", options->fit.prediction,
                  "Samples ahead of the error of prediction")
      ->check(CLI::Range(Index{1}, kMostSamples))
      ->capture_default_str();
  app->add_option("--restarts", options->fit.restarts,
                  "Other starts, at most, where residuals stay above the noise")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  app->add_option("--model-out", options->model_out, "Write the fitted model")
      ->type_name("FILE|-");
  app->add_option("--json", options->json, "Write the result as JSON; - for standard output")
      ->type_name("FILE|-");
  declare_report_options(*app, options->report);
  declare_run_options(*app, options->run);
  return {app, [options](const Session& session) { return fit_command(session, *options); }};
}

}  // namespace lacuna::cli
