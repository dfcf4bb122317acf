// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "plan_parts.hpp"
#include "report/pages/folded_text.hpp"

namespace lacuna {
namespace {

/// The pair of which the worst is expected, of all.
const PairPromise& least_of(const Plan& plan) {
  return *std::min_element(plan.pairs.begin(), plan.pairs.end(),
                           [](const PairPromise& a, const PairPromise& b) {
                             return a.log_bayes_factor < b.log_bayes_factor;
                           });
}

std::string half_width(const std::optional<double>& error) {
  return error ? "+- " + format_number(kNormalQuantile975 * *error, 2) : "not determined";
}

/// "3 of 4 comparisons are decided".
std::string pairs_sentence(const PlanReport& report) {
  const Plan& plan = report.plan;
  const auto decided =
      std::count_if(plan.pairs.begin(), plan.pairs.end(),
                    [](const PairPromise& pair) { return pair.power >= 0.5; });
  const PairPromise& least = least_of(plan);
  const std::string apart = least.truth + " and " + least.rival + " differ by " +
                            format_number(least.sigma, 3) + " sigma";
  if (static_cast<std::size_t>(decided) == plan.pairs.size())
    return "This experiment distinguishes all rivals: even " + apart + " after a refit.";
  if (decided == 0)
    return "No experiment was found that distinguishes these rivals: " + apart +
           " after a refit.";
  return std::to_string(decided) + " of " + std::to_string(plan.pairs.size()) +
         " comparisons are decided by this experiment; " + apart + " after a refit.";
}

std::string parameters_sentence(const Plan& plan) {
  const auto known = std::count_if(plan.parameters.begin(), plan.parameters.end(),
                                   [](const ParameterPromise& one) { return one.after; });
  double narrowest = 1.0;
  std::string name;
  for (const ParameterPromise& one : plan.parameters)
    if (one.before && one.after && *one.after / *one.before < narrowest) {
      narrowest = *one.after / *one.before;
      name = one.name;
    }
  return "After this experiment " + std::to_string(known) + " of " +
         std::to_string(plan.parameters.size()) + " parameters are determined" +
         (name.empty() ? "."
                       : "; the interval of " + name + " becomes " +
                             format_number(1.0 / narrowest, 2) + " times narrower.");
}

}  // namespace

Admission admission_of(const Plan& plan) {
  return admit({.claim = Claim::Fits, .stages = plan.stages});
}

std::string verdict_of(const PlanReport& report) {
  const Plan& plan = report.plan;
  if (const Admission open = admission_of(plan); !open.stands())
    return "Incomplete: " + open.why + "; " + open.remedy + ".";
  if (!plan.is_feasible) return "Infeasible: " + plan.reasons.back() + ".";
  const bool numbers = plan.pairs.empty() || report.options.aim == PlanAim::Parameters;
  return numbers ? parameters_sentence(plan) : pairs_sentence(report);
}

Vector measured_times(const Experiment& experiment) {
  std::vector<double> times;
  for (Index n = 0; n < experiment.time.size(); ++n)
    if (experiment.measured.row(n).maxCoeff() > 0.0) times.push_back(experiment.time[n]);
  return Eigen::Map<const Vector>(times.data(), static_cast<Index>(times.size()));
}

std::vector<std::string> instructions_of(const PlanReport& report) {
  const PlanProblem& problem = report.problem;
  const std::string unit = problem.models.front().system.symbolic().time_unit();
  std::vector<std::string> sentences;
  for (std::size_t r = 0; r < report.plan.runs.size(); ++r) {
    const PlannedRun& run = report.plan.runs[r];
    std::string text = "Run " + std::to_string(r + 1) + ": " +
                       format_number(problem.duration, 6) + (unit == "1" ? "" : " " + unit);
    for (std::size_t i = 0; i < problem.inputs.size(); ++i) {
      const Vector u = run.experiment.inputs.col(static_cast<Index>(i));
      text += ", " + to_string(run.families[i]) + " on " + problem.inputs[i].name + " from " +
              format_number(u.minCoeff(), 4) + " to " + format_number(u.maxCoeff(), 4);
    }
    for (const PlanStart& start : run.experiment.starts)
      text += ", " + start.state + " begins at " + format_number(start.low, 4);
    if (problem.measurements) {
      std::vector<std::string> times;
      for (const double t : measured_times(run.experiment))
        times.push_back(format_number(t, 5));
      text += ", samples at " + join(times, ", ");
    }
    sentences.push_back(text + ".");
  }
  return sentences;
}

std::vector<std::vector<std::string>> pair_rows(const Plan& plan) {
  const bool repeated =
      std::any_of(plan.pairs.begin(), plan.pairs.end(),
                  [](const PairPromise& pair) { return std::isfinite(pair.repeated); });
  std::vector<std::vector<std::string>> rows{
      {"if right", "rival", "sigma apart", "log Bayes factor", "power"}};
  if (repeated) rows.front().push_back("old data repeated");
  for (const PairPromise& pair : plan.pairs) {
    rows.push_back({pair.truth, pair.rival, format_number(pair.sigma, 3),
                    format_number(pair.log_bayes_factor, 3),
                    format_number(100.0 * pair.power, 3) + " %"});
    if (repeated) rows.back().push_back(format_number(pair.repeated, 3));
  }
  return rows;
}

std::vector<std::vector<std::string>> parameter_rows(const Plan& plan) {
  const bool repeated =
      std::any_of(plan.parameters.begin(), plan.parameters.end(),
                  [](const ParameterPromise& one) { return one.repeated.has_value(); });
  std::vector<std::vector<std::string>> rows{
      {"model", "parameter", "value", "95 % before", "95 % after"}};
  if (repeated) rows.front().push_back("old data repeated");
  for (const ParameterPromise& one : plan.parameters) {
    rows.push_back({one.model, one.name,
                    format_number(one.value, 5) + (one.unit.empty() ? "" : " " + one.unit),
                    half_width(one.before), half_width(one.after)});
    if (repeated) rows.back().push_back(half_width(one.repeated));
  }
  return rows;
}

std::string comparison_with_repetition(const Plan& plan) {
  if (!plan.time_saved) return "";
  constexpr double kMost = 9.9e3;  // where the search for the factor ends
  if (*plan.time_saved > kMost)
    return "More of the old data would not do the same in 10000 times the time.";
  return "More of the old data would take " + format_number(*plan.time_saved, 3) +
         " times as long to the same.";
}

std::string format_text(const PlanReport& report) {
  const Plan& plan = report.plan;
  std::string text = verdict_of(report) + "\n\n";
  for (const std::string& sentence : instructions_of(report)) text += sentence + "\n";
  if (!plan.pairs.empty()) text += "\n" + text_table(pair_rows(plan));
  if (!plan.parameters.empty()) text += "\n" + text_table(parameter_rows(plan));
  if (!report.problem.safe.empty())
    for (const PlannedRun& run : plan.runs)
      text += "Safe ranges: left in " + format_number(100.0 * run.leaves, 3) + " % of " +
              std::to_string(report.options.safety_draws) + " draws.\n";
  if (const std::string more = comparison_with_repetition(plan); !more.empty())
    text += more + "\n";
  for (const std::string& reason : plan.reasons) text += "Not decided: " + reason + ".\n";
  return text + "Cost: " + std::to_string(plan.evaluations) + " designs judged by " +
         std::to_string(plan.simulations) + " simulations.\n";
}

}  // namespace lacuna
