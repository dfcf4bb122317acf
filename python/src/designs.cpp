// SPDX-License-Identifier: MIT
// The next experiment, and parts of identify compared.
#include <memory>

#include "answer.hpp"
#include "bindings.hpp"
#include "cli/commands/plan_request.hpp"
#include "lacuna/report/reports.hpp"
#include "report/plans/plan_parts.hpp"

namespace lacuna::python {
namespace {

void take_options(const Given& given, PlanOptions& options) {
  take_named(given, "want", cli::plan_aims(), options.aim);
  take_named(given, "criterion", cli::rival_criteria(), options.rivals);
  take_named(given, "precision", cli::precision_criteria(), options.precision);
  given.take("parameters", options.parameters);
  given.take("runs", options.runs);
  given.take("draws", options.draws);
  given.take("safety_draws", options.safety_draws);
  given.take("safe_probability", options.safe_probability);
  given.take("candidates", options.candidates);
  given.take("searches", options.searches);
  given.take("evaluations", options.evaluations);
  given.take("spread", options.spread);
  given.take("decisive", options.decisive);
}

cli::PlanRequest plan_request(const Given& given) {
  cli::PlanRequest request;
  for (cli::ModelSource& source : models_of(given))
    if (source.given)
      request.given.push_back({source.path, *source.given});
    else
      request.models.push_back(source.path);
  given.take("after", request.after);
  given.take("answer", request.answer);
  take_data(given, request.data);
  given.take("plan_inputs", request.inputs);
  given.take("channels", request.channels);
  given.take("starts", request.starts);
  given.take("safe", request.safe);
  given.take("duration", request.duration);
  given.take("sample", request.step);
  given.take("measurements", request.measurements);
  take_options(given, request.options);
  return request;
}

/// @throws ConfigError for a format that is none.
std::string inputs_of(const PlanReport& report, const std::string& format) {
  if (format == "csv") return format_inputs(report, InputFormat::Csv);
  if (format == "c") return format_inputs(report, InputFormat::C);
  if (format == "awg") return format_inputs(report, InputFormat::Waveform);
  throw ConfigError("format", "'" + format + "' is not known", "give one of csv, c, awg");
}

Answer plan(const Arguments& arguments) {
  const Given given(arguments);
  auto found = answered(given, plan_request(given));
  Answer answer{[found] { return format_json(*found); },
                [found](const TextOptions&) { return format_text(*found); },
                [found] { return plan_page(*found); }};
  answer.inputs = [found](const std::string& format) { return inputs_of(*found, format); };
  const std::vector<std::string>& reasons = found->plan.reasons;
  if (!found->plan.is_feasible)
    answer.failure = reasons.empty() ? "the experiment decides nothing" : reasons.front();
  return answer;
}

Answer bench(const Arguments& arguments) {
  const Given given(arguments);
  cli::BenchRequest request;
  take_data(given, request.data);
  given.take("parts", request.parts);
  given.take("set", request.assignments);
  given.take("noise", request.noise);
  given.take("preset", request.preset);
  given.take("config", request.config);
  given.take("degree", request.degree);
  given.take("draws", request.draws);
  given.take("samples", request.samples);
  auto found = answered(given, std::move(request));
  Answer answer{{},
                [found](const TextOptions&) { return text_of(*found); },
                [found] { return bench_page(found->result, found->subject); }};
  answer.csv = [found] { return format_csv(found->result); };
  answer.failure = found->failure();
  return answer;
}

}  // namespace

void bind_designs(nb::module_& module) {
  module.def("plan", &plan, nb::arg("arguments"));
  module.def("bench", &bench, nb::arg("arguments"));
}

}  // namespace lacuna::python
