// SPDX-License-Identifier: MIT
#include <map>
#include <memory>

#include "answers.hpp"
#include "command.hpp"
#include "lacuna/core/base/error.hpp"
#include "plan_request.hpp"
#include "report/plans/plan_parts.hpp"
#include "report_options.hpp"

namespace lacuna::cli {
namespace {

struct PlanArguments : PlanRequest {
  RunOptions run;
  InputFormat format = InputFormat::Csv;
  std::optional<std::string> inputs_out, json;
  ReportOptions report;
};

bool writes_to_output(const PlanArguments& options) {
  return options.inputs_out == "-" || options.json == "-" || options.report.page == "-";
}

int plan_command(const Session& session, const PlanArguments& options) {
  check_open(options.report);
  const PlanReport report = answer(options, make_context(session, options.run));
  finish_progress(session, options.run);
  if (options.inputs_out)
    write_output(session, *options.inputs_out, format_inputs(report, options.format));
  if (options.json) write_output(session, *options.json, format_json(report));
  write_report(session, options.report, [&] { return plan_page(report); });
  if (!writes_to_output(options)) show(session, format_text(report));
  if (const Admission cut = admission_of(report.plan); !cut.stands())
    return status_of(session, cut);
  return report.plan.is_feasible ? 0 : 1;
}

void declare_task(CLI::App& app, PlanArguments& options) {
  app.add_option("MODEL", options.models, "Model files: one whose parameters are to be "
                                          "determined, or rivals to be distinguished");
  app.add_option("--after", options.after,
                 "JSON of fit, diagnose or identify: the models that it leaves possible")
      ->type_name("RESULT.json");
  app.add_option("--data", options.data.paths,
                 "Records that are there already: models are fitted to them first")
      ->type_name("DATA");
  app.add_option("--input", options.inputs,
                 "What may be done with an input: range, then rate R, hold H, family A|B "
                 "(steps, prbs, multisine, chirp, ramps, spline), pieces N")
      ->type_name("\"NAME=LOW..HIGH, rate R, ...\"");
  app.add_option("--measure", options.channels,
                 "A channel (output or state) and the standard deviation of its noise")
      ->type_name("NAME=SD");
  app.add_option("--start", options.starts,
                 "Where a state begins: a value, a value with a deviation, or a range in which "
                 "it can be set [default: as the model has it, else 0]")
      ->type_name("NAME=V|\"V +- D\"|LOW..HIGH");
  app.add_option("--safe", options.safe, "Range that a state or an output must not leave")
      ->type_name("NAME=LOW..HIGH");
  app.add_option("--duration", options.duration,
                 "Time of a run, in the model's unit [default: of the longest record]")
      ->check(finite())
      ->type_name("T");
  app.add_option("--sample", options.step,
                 "Time between two samples [default: as in the records, else 1/200 of a run]")
      ->check(finite())
      ->type_name("H");
  app.add_option("--times", options.measurements,
                 "So many samples at times that are part of the plan")
      ->check(from_to(1, 1000));
}

void declare_aim(CLI::App& app, PlanOptions& options) {
  app.add_option("--want", options.aim,
                 "What the experiment is for [default: rivals where there are any]")
      ->transform(value_of(plan_aims()))
      ->type_name("rivals|parameters|both");
  app.add_option("--criterion", options.rivals,
                 "How rivals are compared, each refitted [default: bayes-factor, of the pair "
                 "where it is least]")
      ->transform(value_of(rival_criteria()))
      ->type_name("bayes-factor|box-hill|hunter-reiner");
  app.add_option("--precision", options.precision,
                 "What is made large of the information matrix [default: d]")
      ->transform(value_of(precision_criteria()))
      ->type_name("d|a|e|modified-e");
  app.add_option("--parameter", options.parameters, "Parameters that count, no others")
      ->type_name("NAME");
  app.add_option("--runs", options.runs, "Runs, each the best addition to those before")
      ->check(from_to(1, 100))
      ->capture_default_str();
  app.add_option("--decisive", options.decisive, "Log Bayes factor that decides")
      ->check(finite())
      ->capture_default_str();
}

void declare_plan_search(CLI::App& app, PlanOptions& options) {
  app.add_option("--safe-probability", options.safe_probability,
                 "Probability with which the safe ranges are kept")
      ->check(from_to(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--spread", options.spread,
                 "Standard deviation, as a fraction of the size, of a number of which nothing "
                 "is known")
      ->check(above_zero())
      ->capture_default_str();
  app.add_option("--draws", options.draws, "Draws of the parameters in the expectation")
      ->check(from_to(1, 10000))
      ->capture_default_str();
  app.add_option("--safety-draws", options.safety_draws,
                 "Draws of the parameters in the check of the safe ranges")
      ->check(from_to(1, 1000000))
      ->capture_default_str();
  app.add_option("--candidates", options.candidates, "Random designs of each family")
      ->check(from_to(1, 1000000))
      ->capture_default_str();
  app.add_option("--searches", options.searches, "Designs, the best, that are improved")
      ->check(from_to(1, 1000))
      ->capture_default_str();
  app.add_option("--evaluations", options.evaluations, "Designs of each search, at most")
      ->check(from_to(1, 1000000))
      ->capture_default_str();
}

void declare_outputs(CLI::App& app, PlanArguments& options) {
  static const std::map<std::string, InputFormat> kFormats{{"csv", InputFormat::Csv},
                                                           {"c", InputFormat::C},
                                                           {"awg", InputFormat::Waveform}};
  app.add_option("--inputs-out", options.inputs_out, "Write the inputs of the experiment")
      ->type_name(kFile);
  app.add_option("--format", options.format,
                 "How: columns, arrays of C, or text of an arbitrary waveform generator "
                 "[default: csv]")
      ->transform(value_of(kFormats))
      ->type_name("csv|c|awg");
  app.add_option("--json", options.json, "Write the result as JSON; - for standard output")
      ->type_name(kFile);
}

}  // namespace

const std::map<std::string, PlanAim>& plan_aims() {
  static const std::map<std::string, PlanAim> kAims{{"rivals", PlanAim::Rivals},
                                                    {"parameters", PlanAim::Parameters},
                                                    {"both", PlanAim::Both}};
  return kAims;
}

const std::map<std::string, RivalCriterion>& rival_criteria() {
  static const std::map<std::string, RivalCriterion> kRivals{
      {"bayes-factor", RivalCriterion::BayesFactor},
      {"box-hill", RivalCriterion::BoxHill},
      {"hunter-reiner", RivalCriterion::HunterReiner}};
  return kRivals;
}

const std::map<std::string, PrecisionCriterion>& precision_criteria() {
  static const std::map<std::string, PrecisionCriterion> kPrecision{
      {"d", PrecisionCriterion::D},
      {"a", PrecisionCriterion::A},
      {"e", PrecisionCriterion::E},
      {"modified-e", PrecisionCriterion::ModifiedE}};
  return kPrecision;
}

Command declare_plan(CLI::App& root) {
  auto options = std::make_shared<PlanArguments>();
  CLI::App* app = root.add_subcommand(
      "plan", "Design the experiment that distinguishes models or determines parameters");
  declare_task(*app, *options);
  declare_aim(*app, options->options);
  declare_plan_search(*app, options->options);
  declare_column_options(*app, options->data, false);
  declare_outputs(*app, *options);
  declare_report_options(*app, options->report);
  declare_run_options(*app, options->run);
  declare_time_limit(*app, options->run);
  return {app, [options](const Session& session) { return plan_command(session, *options); }};
}

}  // namespace lacuna::cli
