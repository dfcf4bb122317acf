// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <memory>

#include "answers.hpp"
#include "assignments.hpp"
#include "cli/terminal/first_screen.hpp"
#include "command.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "data_options.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/gaps.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "lacuna/report/reports.hpp"
#include "records/channels/shown_holds.hpp"
#include "report/pages/pages.hpp"
#include "report_options.hpp"

namespace lacuna::cli {
namespace {

/// What fits into no number is read as the largest one, which no record is as long as.
constexpr double kMostSamples = 1125899906842624.0;

struct FitArguments : FitRequest {
  RunOptions run;
  std::optional<std::string> model_out, json;
  std::vector<std::string> deviations;
  ReportOptions report;
  Digits digits;
};

/// A sample that one channel lacks says something of the others, and a row without any value
/// that the model passes its time. The model is carried on from one row to the next, however
/// far they are apart.
Dataset read(const OdeModel& model, const RecordSources& sources, const FitRequest& request) {
  ColumnRoles roles = common_roles(request.data);
  roles.blanks = Blanks::Keep;
  const Columns columns = request.fit.deviations.empty() ? Columns::OfModel : Columns::All;
  return join_across_gaps(records_for(model, sources, roles, FiniteDifferences{}, columns));
}

/// The system with the holds of its inputs as given, and as the samples show them.
SystemModel with_all_holds(const SystemModel& system, const OdeModel& plain) {
  std::vector<std::optional<Hold>> holds;
  for (const Quantity& input : system.symbolic().inputs()) holds.push_back(input.hold);
  for (std::size_t i = 0; i < plain.inputs().size(); ++i) holds[i] = plain.inputs()[i].hold;
  return {system.symbolic().with_holds(holds), system.parameters()};
}

/// Whether a file is a model by its ending; no record has one of these.
bool is_rival(const std::string& path) {
  const std::filesystem::path ending = std::filesystem::path(path).extension();
  return ending == ".ode" || ending == ".json";
}

/// Models among the data: rivals of the first.
std::vector<ModelSource> take_models(FitArguments& options) {
  std::vector<ModelSource> models{options.model};
  std::erase_if(options.data.paths, [&](const std::string& path) {
    if (is_rival(path)) models.push_back({path});
    return is_rival(path);
  });
  if (options.data.paths.empty())
    throw ConfigError("DATA", "only models are given", "give files of records behind them");
  return models;
}

int compare_models(const Session& session, const FitArguments& options,
                   const std::vector<ModelSource>& models) {
  const std::vector<NamedFit> fits =
      answers(options, models, make_context(session, options.run));
  finish_progress(session, options.run);
  const RivalComparison comparison = compare_fits(fits);
  const auto best = std::find_if(fits.begin(), fits.end(), [&](const NamedFit& one) {
    return one.name == comparison.rivals.front().name;
  });
  if (options.model_out)
    write_output(session, *options.model_out,
                 model_text(*options.model_out, best->fit.model, options.digits));
  if (options.json) write_output(session, *options.json, format_json(comparison));
  write_report(session, options.report, [&] { return fit_page(best->fit); });
  if (options.json != "-" && options.model_out != "-" && options.report.page != "-")
    show(session, format_text(comparison));
  return best->fit.converged ? 0 : 1;
}

/// Columns of standard deviations, as NAME=COLUMN gives them.
std::vector<KnownDeviation> read_deviations(const std::vector<std::string>& assignments) {
  std::vector<KnownDeviation> known;
  for (const Assignment& part :
       read_assignments({"--deviation", "NAME=COLUMN", "--deviation y=sd"}, assignments))
    known.push_back({part.name, part.value});
  return known;
}

/// The fit. Somebody who watches sees that from the given start first where the whole one takes
/// longer than a moment: it stays on the terminal where the rest is interrupted.
Fit watched_fit(const Session& session, const FitArguments& options) {
  RunContext context = make_context(session, options.run);
  FirstScreen screen(session.streams.err, session.begin);
  if (is_watched(session, options.run) && !context.deadline &&
      options.run.effort != Thoroughness::Quick) {
    FitRequest quick = options;
    quick.conditions = {};
    quick.fit.effort = Thoroughness::Quick;
    quick.fit.profile = quick.fit.bands = false;
    screen.take("First answer, from the given start; other starts and intervals follow\n" +
                format_text(answer(quick, context)) + "\n");
    context.progress = beside(screen, std::move(context.progress));
  }
  return answer(options, context);
}

int fit_command(const Session& session, FitArguments options) {
  options.fit.deviations = read_deviations(options.deviations);
  check_open(options.report);
  options.fit.effort = options.run.effort;
  const std::vector<ModelSource> models = take_models(options);
  if (models.size() > 1) return compare_models(session, options, models);
  const Fit found = watched_fit(session, options);
  finish_progress(session, options.run);
  if (options.model_out)
    write_output(session, *options.model_out,
                 model_text(*options.model_out, found.model, options.digits));
  if (options.json) write_output(session, *options.json, format_json(found));
  write_report(session, options.report, [&] { return fit_page(found); });
  if (options.json != "-" && options.model_out != "-" && options.report.page != "-")
    show(session, format_text(found));
  return found.converged ? 0 : 1;
}

/// Names of columns for a model and of those with standard deviations.
std::vector<std::string> fitted_names(const SystemModel& system, const FitRequest& request) {
  std::vector<std::string> names = column_names(system.model());
  for (const KnownDeviation& known : request.fit.deviations) names.push_back(known.column);
  return names;
}

/// The fit of one model; columns may have names that it does not know.
Fit fit_of(const SystemModel& system, const FitRequest& request, const RunContext& context) {
  const OdeModel given = with_holds(system.model(), request.data);
  context.unhurried().report("reading data", 0.0);
  const Dataset data = read(given, request.data, request);
  const Dataset held_out =
      request.held_out.empty() ? Dataset{} : read(given, request.held_out, request);
  const SystemModel held = with_all_holds(system, with_shown_holds(given, data));
  const Dataset conditions =
      request.conditions.empty()
          ? Dataset{}
          : conditions_for(given, request.conditions, common_roles(request.data));
  Fit found = fit(held, data, held_out, request.fit, context);
  if (request.conditions.empty()) return found;
  found.predicted = predict(found, conditions);
  found.notes.insert(found.notes.end(), conditions.notes.begin(), conditions.notes.end());
  return found;
}

}  // namespace

Fit answer(const FitRequest& request, const RunContext& context) {
  const SystemModel system = load_system(request.model);
  check_map(request.data, fitted_names(system, request));
  return fit_of(system, request, context);
}

std::vector<NamedFit> answers(const FitRequest& request, const std::vector<ModelSource>& models,
                              const RunContext& context) {
  std::vector<SystemModel> systems;
  std::vector<std::string> names;
  for (const ModelSource& model : models) {
    systems.push_back(load_system(model));
    const std::vector<std::string> own = fitted_names(systems.back(), request);
    names.insert(names.end(), own.begin(), own.end());
  }
  check_map(request.data, names);
  std::vector<NamedFit> fits;
  for (std::size_t i = 0; i < models.size(); ++i)
    fits.push_back({models[i].path, fit_of(systems[i], request, context)});
  return fits;
}

Command declare_fit() {
  auto options = std::make_shared<FitArguments>();
  Command command{"fit",
                  "Estimate the numbers of a model of known structure, hidden states too"};
  command.add("MODEL", &options->model.path, "Model file, or the name of a test system")
      .require();
  command
      .add("DATA", &options->data.paths,
           "Files (text, .gz, .npy) or quoted patterns; further models (.ode, .json) "
           "among them are compared with the first")
      .require();
  command.add("--holdout DATA", &options->held_out.paths, "Records to check the fit on");
  declare_column_options(command, options->data, false);
  command
      .add("--start-samples", &options->fit.window,
           "First samples of a held-out record, which give its initial state")
      .check(from_to(1, kMostSamples))
      .show_default();
  command
      .add("--start-time T", &options->fit.start_time,
           "Time at which records begin and initial values hold, before the first "
           "sample")
      .check(finite());
  command.add("--deviation NAME=COLUMN", &options->deviations,
              "Column with the standard deviation of each value of a column");
  command.add("--ahead", &options->fit.prediction, "Samples ahead of the error of prediction")
      .check(from_to(1, kMostSamples))
      .show_default();
  command
      .add("--restarts", &options->fit.restarts,
           "Other starts, at most, where residuals stay above the noise")
      .check(from_to(0, 100))
      .show_default();
  command
      .add("--starts", &options->fit.starts,
           "Starts anywhere in the ranges of parameters, at most, wherever the first fit "
           "ends [default: " +
               std::to_string(options->fit.range_starts) + ", with many samples " +
               std::to_string(options->fit.range_starts_of_many) +
               ", where a range is wide and residuals are above the noise]")
      .check(from_to(0, 10000));
  command.add("--profile", &options->fit.profile,
              "Profiles of the likelihood of every number, however long it takes");
  command.add("--bands", &options->fit.bands,
              "90 % bands of the free runs and of measured values");
  command.add("--predict DATA", &options->conditions.paths,
              "Times, inputs and initial values of runs to predict, with bands");
  command.add("--model-out FILE|-", &options->model_out, "Write the fitted model");
  command.add("--json FILE|-", &options->json,
              "Write the result as JSON; - for standard output");
  declare_digits_option(
      command, options->digits,
      "Digits of numbers in a .ode file of --model-out: auto (two of the 95 % "
      "interval), full, or so many; JSON has all [default: auto]");
  declare_report_options(command, options->report);
  declare_effort_options(command, options->run);
  declare_run_options(command, options->run);
  command.run = [options](const Session& session) { return fit_command(session, *options); };
  return command;
}

}  // namespace lacuna::cli
