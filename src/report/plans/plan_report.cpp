// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/json.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/report/reports.hpp"
#include "plan_parts.hpp"
#include "report/json/stages_json.hpp"

namespace lacuna {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json finite_or_null(const std::optional<double>& value) {
  return value ? number_or_null(*value) : Json(nullptr);
}

Json list_of(const Vector& values) { return std::vector<double>(values.begin(), values.end()); }

Json input_json(const PlanProblem& problem, const Experiment& experiment) {
  Json values = Json::object();
  for (std::size_t i = 0; i < problem.inputs.size(); ++i)
    values[problem.inputs[i].name] = list_of(experiment.inputs.col(static_cast<Index>(i)));
  return {{"time", list_of(experiment.time)}, {"values", std::move(values)}};
}

Json run_json(const PlanProblem& problem, const PlannedRun& run) {
  Json families = Json::object(), starts = Json::object();
  for (std::size_t i = 0; i < problem.inputs.size(); ++i)
    families[problem.inputs[i].name] = to_string(run.families[i]);
  for (const PlanStart& start : run.experiment.starts) starts[start.state] = start.low;
  Json json{{"families", std::move(families)},
            {"input", input_json(problem, run.experiment)},
            {"start", std::move(starts)},
            {"measured_at", problem.measurements ? list_of(measured_times(run.experiment))
                                                 : Json(nullptr)},
            {"leaves_safe_ranges", run.leaves},
            {"responses", Json::array()}};
  for (const PredictedResponse& response : run.responses)
    json["responses"].push_back({{"model", response.model},
                                 {"channel", response.channel},
                                 {"mean", list_of(response.mean)},
                                 {"low", list_of(response.low)},
                                 {"high", list_of(response.high)}});
  return json;
}

Json pairs_json(const Plan& plan) {
  Json list = Json::array();
  for (const PairPromise& pair : plan.pairs)
    list.push_back({{"truth", pair.truth},
                    {"rival", pair.rival},
                    {"log_bayes_factor", number_or_null(pair.log_bayes_factor)},
                    {"sigma", number_or_null(pair.sigma)},
                    {"power", number_or_null(pair.power)},
                    {"repeated", number_or_null(pair.repeated)}});
  return list;
}

Json interval_or_null(double value, const std::optional<double>& error) {
  if (!error) return nullptr;
  return interval95(value, *error);
}

Json parameters_json(const Plan& plan) {
  Json list = Json::array();
  for (const ParameterPromise& number : plan.parameters)
    list.push_back({{"model", number.model},
                    {"name", number.name},
                    {"unit", number.unit},
                    {"value", number_or_null(number.value)},
                    {"stderr_before", finite_or_null(number.before)},
                    {"stderr", finite_or_null(number.after)},
                    {"ci95", interval_or_null(number.value, number.after)},
                    {"stderr_repeated", finite_or_null(number.repeated)}});
  return list;
}

Json safe_json(const PlanReport& report) {
  Json ranges = Json::array();
  for (const SafeRange& range : report.problem.safe)
    ranges.push_back({{"name", range.name},
                      {"low", number_or_null(range.low)},
                      {"high", number_or_null(range.high)}});
  double leaves = 0.0;
  for (const PlannedRun& run : report.plan.runs) leaves = std::max(leaves, run.leaves);
  return {{"ranges", std::move(ranges)},
          {"probability", report.options.safe_probability},
          {"draws", report.problem.safe.empty() ? 0 : report.options.safety_draws},
          {"leaves", leaves}};
}

}  // namespace

std::string format_json(const PlanReport& report) {
  const Plan& plan = report.plan;
  Json json{{"format", "lacuna.plan/1"},
            {"verdict", verdict_of(report)},
            {"feasible", plan.is_feasible},
            {"reasons", plan.reasons},
            {"input", input_json(report.problem, plan.runs.at(0).experiment)},
            {"promise",
             {{"pairs", pairs_json(plan)},
              {"decisive", report.options.decisive},
              {"parameters", parameters_json(plan)}}},
            {"safe", safe_json(report)},
            {"cost",
             {{"runs", plan.runs.size()},
              {"duration", report.problem.duration},
              {"designs", plan.evaluations},
              {"simulations", plan.simulations},
              {"time_saved", finite_or_null(plan.time_saved)}}},
            {"runs", Json::array()},
            {"stages", stages_json(plan.stages)}};
  for (const PlannedRun& run : plan.runs)
    json["runs"].push_back(run_json(report.problem, run));
  return json_lines(json);
}

}  // namespace lacuna
