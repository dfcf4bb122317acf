// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "core/base/text.hpp"
#include "plan_parts.hpp"
#include "report/pages/readable.hpp"
#include "report/pages/page.hpp"

namespace lacuna {
namespace {

Markup table_of(std::vector<std::vector<std::string>> rows) {
  const std::vector<std::string> heads = rows.front();
  rows.erase(rows.begin());
  return table(heads, rows);
}

std::string time_label(const PlanProblem& problem) {
  const std::string unit = problem.models.front().system.symbolic().time_unit();
  return with_unit("t", unit == "1" ? "" : unit);
}

std::vector<Picture> input_pictures(const PlanReport& report, std::size_t r) {
  const Experiment& run = report.plan.runs[r].experiment;
  std::vector<Picture> pictures;
  for (std::size_t i = 0; i < report.problem.inputs.size(); ++i) {
    const std::string& name = report.problem.inputs[i].name;
    // A held value goes on until the next one: two points for each.
    const Index n = run.time.size();
    Vector x(2 * n - 1), y(2 * n - 1);
    for (Index k = 0; k < 2 * n - 1; ++k) {
      x[k] = run.time[(k + 1) / 2];
      y[k] = run.inputs(k / 2, static_cast<Index>(i));
    }
    pictures.push_back(draw(LineFigure{
        "input_" + std::to_string(r + 1) + "_" + name, "Input " + name, time_label(report.problem),
        name, {{name, std::move(x), std::move(y), Curve::Model}}}));
  }
  return pictures;
}

constexpr std::array<Curve, 4> kCurves{Curve::Measured, Curve::Before, Curve::Model,
                                       Curve::Other};

std::vector<Picture> response_pictures(const PlanReport& report, std::size_t r) {
  const PlannedRun& run = report.plan.runs[r];
  std::vector<Picture> pictures;
  for (const PlanChannel& channel : report.problem.channels) {
    LineFigure figure{"responses_" + std::to_string(r + 1) + "_" + channel.name,
                      "Predicted " + channel.name + ": means, and 95 % of the draws between "
                                                    "the dotted ends",
                      time_label(report.problem), channel.name, {}};
    std::size_t model = 0;
    for (const PredictedResponse& response : run.responses) {
      if (response.channel != channel.name) continue;
      figure.y_label = with_unit(channel.name, response.unit);
      const Curve curve = kCurves[model++ % kCurves.size()];
      figure.series.push_back({response.model, run.experiment.time, response.mean, curve});
      figure.series.push_back(
          {response.model + ", low", run.experiment.time, response.low, curve, true});
      figure.series.push_back(
          {response.model + ", high", run.experiment.time, response.high, curve, true});
    }
    pictures.push_back(draw(figure));
  }
  return pictures;
}

}  // namespace

Page plan_page(const PlanReport& report) {
  const Plan& plan = report.plan;
  Page page;
  page.title = "The next experiment";
  page.headline = verdict_of(report);
  page.tone = !plan.is_feasible        ? Tone::Bad
              : plan.reasons.empty() ? Tone::Good
                                     : Tone::Doubtful;
  page.findings = instructions_of(report);
  if (const std::string more = comparison_with_repetition(plan); !more.empty())
    page.findings.push_back(more);
  page.facts.push_back({"Duration",
                        format_number(report.problem.duration * double(plan.runs.size()), 5),
                        std::to_string(plan.runs.size()) +
                            (plan.runs.size() == 1 ? " run" : " runs")});
  page.facts.push_back({"Designs judged", std::to_string(plan.evaluations),
                        std::to_string(plan.simulations) + " simulations"});
  if (!plan.pairs.empty())
    page.sections.push_back({"What it distinguishes", table_of(pair_rows(plan))});
  if (!plan.parameters.empty())
    page.sections.push_back({"What it determines", table_of(parameter_rows(plan))});
  if (!plan.reasons.empty())
    page.sections.push_back({"What it does not decide", bullets(plan.reasons)});
  for (std::size_t r = 0; r < plan.runs.size(); ++r) {
    const std::string of = plan.runs.size() == 1 ? "" : " of run " + std::to_string(r + 1);
    if (!report.problem.inputs.empty())
      page.sections.push_back({"Inputs" + of, {}, input_pictures(report, r)});
    page.sections.push_back({"Predictions" + of, {}, response_pictures(report, r)});
  }
  return page;
}

}  // namespace lacuna
