// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>

#include "answers.hpp"
#include "assignments.hpp"
#include "command.hpp"
#include "core/base/text.hpp"
#include "data_options.hpp"
#include "dynamics/integration/automatic.hpp"
#include "lacuna/core/numerics/sampled_signal.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "records/channels/shown_holds.hpp"
#include "report/pages/data_summary.hpp"
#include "report/pages/folded_text.hpp"
#include "report/pages/pages.hpp"
#include "report_options.hpp"

namespace lacuna::cli {
namespace {

struct SyncArguments : SyncRequest {
  RunOptions run;
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
  for (const std::string& note : said_once(data.notes)) lines += "Note: " + note + "\n";
  if (report.result.stiff)
    lines +=
        "Note: the slave is faster than the samples: its steps between them were adapted\n";
  if (report.result.by_fixed_steps)
    lines += "Note: steps that adapt got too small, as where rates jump: fixed steps were taken "
             "(rk4), and halved once to see what they add\n";
  return lines;
}

/// Whether any table has channels with times of their own, as joined logs do.
bool have_own_times(const SyncRequest& request) {
  const auto has = [](const Table& table) { return table.own_times; };
  const RecordSources& sources = request.data;
  if (!sources.tables.empty())
    return std::any_of(sources.tables.begin(), sources.tables.end(), has);
  const std::vector<std::string> paths = expand_patterns(sources.paths);
  const ColumnRoles roles = common_roles(request.data);
  return std::any_of(paths.begin(), paths.end(), [&](const std::string& path) {
    return has(read_table(path, roles));
  });
}

/// Whether an input that jumps does so where no state has a sample.
bool jumps_between_samples(const std::vector<Quantity>& inputs, const Dataset& kept) {
  const double missing = number_of(Mark::Missing);
  for (const Trajectory& run : kept.trajectories) {
    const Matrix marks = marks_of(run);
    for (std::size_t j = 0; j < inputs.size(); ++j) {
      if (is_smooth(interpolation_of(inputs[j].hold))) continue;
      const auto values = run.inputs.col(static_cast<Index>(j));
      for (Index n = 1; n < run.samples(); ++n)
        if (values[n] != values[n - 1] && (marks.row(n).array() == missing).all()) return true;
    }
  }
  return false;
}

/// A slave is driven from sample to sample of the states: an input of a log of its own, which
/// jumps between them, is late there by up to a sample.
SyncVerdict beside_late_inputs(SyncVerdict verdict, const OdeModel& driven,
                               const SyncRequest& request, const Differentiator& differentiator) {
  if (verdict.holds || !verdict.decided || driven.inputs().empty() || !have_own_times(request))
    return verdict;
  ColumnRoles roles = common_roles(request.data);
  roles.blanks = Blanks::Keep;
  const Dataset kept = records_for(driven, request.data, roles, differentiator);
  if (!jumps_between_samples(driven.inputs(), kept)) return verdict;
  return left_open(verdict, {"the slave is off, but an input jumps between the samples that drive "
                             "it, and comes late by up to one",
                             "use `lacuna fit` or `lacuna diagnose`, which take each channel at "
                             "its own times"});
}

int sync_command(const Session& session, const SyncArguments& options) {
  check_open(options.report);
  const SyncAnswer found =
      answer(session.registry, options, make_context(session, options.run));
  finish_progress(session, options.run);
  if (options.json) write_output(session, *options.json, format_json(found.report));
  write_report(session, options.report, [&] { return sync_page(found.report, found.data); });
  if (options.json != "-" && options.report.page != "-") show(session, text_of(found));
  if (const Admission cut = admission_of(found.report.result); !cut.stands())
    return status_of(session, cut);
  const std::string failure = failure_of(found);
  if (failure.empty()) return 0;
  session.streams.err << "lacuna: error: " << failure << "\n";
  return 1;
}

}  // namespace

SyncAnswer answer(const Registry& registry, const SyncRequest& request,
                  const RunContext& context) {
  const OdeModel model = with_holds(load_model(request.model), request.data);
  const auto integrator = registry.make<Integrator>(request.integrator);
  const auto differentiator = registry.make<Differentiator>(request.differentiator);
  const std::optional<Matrix> coupling = parse_coupling(model, request.coupling);
  check_map(request.data, column_names(model));
  context.unhurried().report("reading data", 0.0);
  const Dataset all = long_enough(records_for(model, request.data, common_roles(request.data),
                                              *differentiator, Columns::All),
                                  *integrator);
  Dataset data = used_part(model, all);
  check_outputs_are_states(model, data);
  const OdeModel driven = with_shown_holds(model, data);
  SyncReport report{synchronise(driven, data, *integrator, {.coupling = coupling}, context),
                    model.states(), data.time_unit, coupling.has_value(), request.integrator};
  if (report.result.stiff) report.integrator = AutomaticOptions::kInfo.name;
  if (report.result.by_fixed_steps) report.integrator = Rk4Options::kInfo.name;
  report.verdict =
      beside_late_inputs(judge(driven, data, report.result), driven, request, *differentiator);
  return {std::move(report), std::move(data),
          data_line(all, static_cast<Index>(model.inputs().size()))};
}

std::string text_of(const SyncAnswer& answer) {
  return answer.read + "\n" + notes_of(answer.data, answer.report) + "\n" +
         format_text(answer.report);
}

std::string failure_of(const SyncAnswer& answer) {
  const SyncResult& result = answer.report.result;
  if (result.status == IntegrationStatus::Completed) return "";
  if (result.status == IntegrationStatus::StepTooSmall)
    return result.message + "; try fixed steps (--integrator rk4)";
  return result.message + "; try " + stronger_coupling(answer.report.states, result.coupling);
}

Command declare_sync() {
  auto options = std::make_shared<SyncArguments>();
  Command command{"sync",
                  "Drive a model with a record and measure how far from it the model stays"};
  command.add("MODEL", &options->model.path, "Model file, or the name of a test system")
      .require();
  command.add("DATA", &options->data.paths, "Files (text, .gz, .npy) or quoted patterns")
      .require();
  declare_column_options(command, options->data, false);
  command.add("--coupling NAME=K,...", &options->coupling,
              "Coupling of each named state, in 1/time unit [default: all states, from the "
              "record's own time scale]");
  command.add("--integrator NAME", &options->integrator, "Method").show_default();
  command
      .add("--differentiator NAME", &options->differentiator,
           "How states without a column are made from those that have one")
      .show_default();
  command.add("--json FILE|-", &options->json,
              "Write the result as JSON; - for standard output");
  declare_report_options(command, options->report);
  declare_run_options(command, options->run);
  declare_time_limit(command, options->run);
  command.run = [options](const Session& session) { return sync_command(session, *options); };
  return command;
}

}  // namespace lacuna::cli
