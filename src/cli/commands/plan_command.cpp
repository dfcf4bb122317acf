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

void declare_task(Command& command, PlanArguments& options) {
  command.add("MODEL", &options.models,
              "Model files: one whose parameters are to be "
              "determined, or rivals to be distinguished");
  command.add("--after RESULT.json", &options.after,
              "JSON of fit, diagnose or identify: the models that it leaves possible");
  command.add("--data DATA", &options.data.paths,
              "Records that are there already: models are fitted to them first");
  command.add("--input \"NAME=LOW..HIGH, rate R, ...\"", &options.inputs,
              "What may be done with an input: range, then rate R, hold H, family A|B "
              "(steps, prbs, multisine, chirp, ramps, spline), pieces N");
  command.add("--measure NAME=SD", &options.channels,
              "A channel (output or state) and the standard deviation of its noise");
  command.add("--start NAME=V|\"V +- D\"|LOW..HIGH", &options.starts,
              "Where a state begins: a value, a value with a deviation, or a range in which "
              "it can be set [default: as the model has it, else 0]");
  command.add("--safe NAME=LOW..HIGH", &options.safe,
              "Range that a state or an output must not leave");
  command
      .add("--duration T", &options.duration,
           "Time of a run, in the model's unit [default: of the longest record]")
      .check(finite());
  command
      .add("--sample H", &options.step,
           "Time between two samples [default: as in the records, else 1/200 of a run]")
      .check(finite());
  command
      .add("--times", &options.measurements,
           "So many samples at times that are part of the plan")
      .check(from_to(1, 1000));
}

void declare_aim(Command& command, PlanOptions& options) {
  command.add("--want rivals|parameters|both", word_of(plan_aims(), options.aim),
              "What the experiment is for [default: rivals where there are any]");
  command.add("--criterion bayes-factor|box-hill|hunter-reiner",
              word_of(rival_criteria(), options.rivals),
              "How rivals are compared, each refitted [default: bayes-factor, of the pair "
              "where it is least]");
  command.add("--precision d|a|e|modified-e", word_of(precision_criteria(), options.precision),
              "What is made large of the information matrix [default: d]");
  command.add("--parameter NAME", &options.parameters, "Parameters that count, no others");
  command.add("--runs", &options.runs, "Runs, each the best addition to those before")
      .check(from_to(1, 100))
      .show_default();
  command.add("--decisive", &options.decisive, "Log Bayes factor that decides")
      .check(finite())
      .show_default();
}

void declare_plan_search(Command& command, PlanOptions& options) {
  command
      .add("--safe-probability", &options.safe_probability,
           "Probability with which the safe ranges are kept")
      .check(from_to(0.0, 1.0))
      .show_default();
  command
      .add("--spread", &options.spread,
           "Standard deviation, as a fraction of the size, of a number of which nothing "
           "is known")
      .check(above_zero())
      .show_default();
  command.add("--draws", &options.draws, "Draws of the parameters in the expectation")
      .check(from_to(1, 10000))
      .show_default();
  command
      .add("--safety-draws", &options.safety_draws,
           "Draws of the parameters in the check of the safe ranges")
      .check(from_to(1, 1000000))
      .show_default();
  command.add("--candidates", &options.candidates, "Random designs of each family")
      .check(from_to(1, 1000000))
      .show_default();
  command.add("--searches", &options.searches, "Designs, the best, that are improved")
      .check(from_to(1, 1000))
      .show_default();
  command.add("--evaluations", &options.evaluations, "Designs of each search, at most")
      .check(from_to(1, 1000000))
      .show_default();
}

void declare_outputs(Command& command, PlanArguments& options) {
  static const std::map<std::string, InputFormat> kFormats{{"csv", InputFormat::Csv},
                                                           {"c", InputFormat::C},
                                                           {"awg", InputFormat::Waveform}};
  command.add("--inputs-out FILE|-", &options.inputs_out, "Write the inputs of the experiment");
  command.add("--format csv|c|awg", word_of(kFormats, options.format),
              "How: columns, arrays of C, or text of an arbitrary waveform generator "
              "[default: csv]");
  command.add("--json FILE|-", &options.json,
              "Write the result as JSON; - for standard output");
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

Command declare_plan() {
  auto options = std::make_shared<PlanArguments>();
  Command command{"plan",
                  "Design the experiment that distinguishes models or determines parameters"};
  declare_task(command, *options);
  declare_aim(command, options->options);
  declare_plan_search(command, options->options);
  declare_column_options(command, options->data, false);
  declare_outputs(command, *options);
  declare_report_options(command, options->report);
  declare_run_options(command, options->run);
  declare_time_limit(command, options->run);
  command.run = [options](const Session& session) { return plan_command(session, *options); };
  return command;
}

}  // namespace lacuna::cli
