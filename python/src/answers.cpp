// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>

#include "answer.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "core/base/utf8.hpp"
#include "figures.hpp"
#include "lacuna/data/formats/write.hpp"
#include "lacuna/report/reports.hpp"
#include "own_stages.hpp"
#include "report/pages/folded_text.hpp"

namespace lacuna::python {
namespace {

Answer identify(const Arguments& arguments) {
  const Given given(arguments);
  cli::IdentifyRequest request;
  take_data(given, request.data);
  take_held_out(given, request.held_out);
  given.take("preset", request.preset);
  given.take("config", request.config);
  given.take("config_text", request.config_text);
  given.take("terms", request.terms);
  given.take("degree", request.degree);
  given.take("hidden", request.hidden);
  given.take("set", request.assignments);
  given.take("equations", request.equations);
  given.take("add", request.added);
  given.take("constraints", request.constraints);
  given.take("discrete", request.discrete);
  given.take("integrator", request.integrator);
  given.take("memory", request.memory);
  take_named(given, "effort", cli::efforts(), request.effort);
  given.take_own<WrittenBasis>("own_basis", [&](auto part) { request.basis.emplace(part); });
  given.take_own<WrittenRegressor>("own_regressor",
                                   [&](auto part) { request.regressor.emplace(part); });
  auto found = answered(given, std::move(request));
  Answer answer{
      [found] { return format_json(found->report); },
      [found](const TextOptions& options) { return text_of(*found, options); },
      [found] { return identification_page(found->report, found->records.excerpt()); }};
  answer.model.emplace(found->report.result.model);
  answer.warnings = found->report.result.warnings;
  if (!found->found()) answer.failure = "no equation was found";
  return answer;
}

Answer diagnose(const Arguments& arguments) {
  const Given given(arguments);
  cli::DiagnoseRequest request;
  take_model(given, request.model);
  take_data(given, request.data);
  take_held_out(given, request.held_out);
  given.take("limits", request.limits);
  given.take("effects", request.effects);
  given.take("tolerances", request.tolerances);
  given.take("set", request.assignments);
  given.take("differentiator", request.differentiator);
  given.take("config", request.config);
  given.take("max_effects", request.max_effects);
  given.take("fill_gap", request.fill_gap);
  take_named(given, "effort", cli::efforts(), request.effort);
  given.take_own<WrittenEffect>("own_effects",
                                [&](auto part) { request.own_effects.emplace_back(part); });
  auto found = answered(given, std::move(request));
  Answer answer{[found] { return format_json(found->diagnosis, found->augmented); },
                [found](const TextOptions&) { return text_of(*found); },
                [found] { return diagnosis_page(found->diagnosis); },
                [found] { return explanation_of(*found, {}); }};
  answer.model.emplace(found->augmented);
  return answer;
}

cli::FitRequest fit_request(const Given& given) {
  cli::FitRequest request;
  take_data(given, request.data);
  take_held_out(given, request.held_out);
  given.take("start_samples", request.fit.window);
  given.take("start_time", request.fit.start_time);
  given.take("ahead", request.fit.prediction);
  given.take("restarts", request.fit.restarts);
  given.take("starts", request.fit.starts);
  given.take("profile", request.fit.profile);
  given.take("bands", request.fit.bands);
  given.take("condition_paths", request.conditions.paths);
  given.take("condition_tables", request.conditions.tables);
  take_named(given, "effort", cli::efforts(), request.fit.effort);
  return request;
}

Answer fit(const Arguments& arguments) {
  const Given given(arguments);
  cli::FitRequest request = fit_request(given);
  take_model(given, request.model);
  auto found = answered(given, std::move(request));
  Answer answer{[found] { return format_json(*found); },
                [found](const TextOptions&) { return format_text(*found); },
                [found] { return fit_page(*found); }};
  answer.model.emplace(found->model);
  if (!found->converged) answer.failure = "the fit did not converge";
  return answer;
}

/// Several models fitted to the same records; the model and the page are those of the best.
Answer fit_rivals(const Arguments& arguments) {
  const Given given(arguments);
  std::vector<cli::ModelSource> models = models_of(given);
  auto fits = ended(
      given, [request = fit_request(given), models = std::move(models)](
                 const RunContext& context) { return cli::answers(request, models, context); });
  auto compared = std::make_shared<const RivalComparison>(compare_fits(*fits));
  const auto best = std::find_if(fits->begin(), fits->end(), [&](const NamedFit& one) {
    return one.name == compared->rivals.front().name;
  });
  Answer answer{[compared] { return format_json(*compared); },
                [compared](const TextOptions&) { return format_text(*compared); },
                [fits, best] { return fit_page(best->fit); }};
  answer.model.emplace(best->fit.model);
  if (!best->fit.converged) answer.failure = "the fit did not converge";
  return answer;
}

Answer sync(const Arguments& arguments) {
  const Given given(arguments);
  cli::SyncRequest request;
  take_model(given, request.model);
  take_data(given, request.data);
  given.take("coupling", request.coupling);
  given.take("integrator", request.integrator);
  given.take("differentiator", request.differentiator);
  auto found = answered(given, std::move(request));
  Answer answer{[found] { return format_json(found->report); },
                [found](const TextOptions&) { return text_of(*found); },
                [found] { return sync_page(found->report, found->data); }};
  answer.failure = failure_of(*found);
  return answer;
}

Answer compare(const Arguments& arguments) {
  const Given given(arguments);
  cli::CompareRequest request;
  take_model(given, request.model);
  take_data(given, request.data);
  given.take("first_tables", request.first.tables);
  given.take("integrator", request.integrator);
  given.take("differentiator", request.differentiator);
  auto found = answered(given, std::move(request));
  Answer answer{[found] { return format_json(found->report); },
                [found](const TextOptions&) { return format_text(found->report); }};
  answer.failure = found->problem;
  return answer;
}

Answer check(const Arguments& arguments) {
  const Given given(arguments);
  cli::CheckRequest request;
  take_data(given, request.data);
  given.take("differentiator", request.differentiator);
  if (given.has("model") || given.has("model_path")) take_model(given, request.model.emplace());
  auto found = answered(given, std::move(request));
  return {[found] { return format_json(*found); },
          [found](const TextOptions&) { return format_text(*found); }};
}

/// What was simulated, as a record.
struct SimulatedOrbit {
  std::shared_ptr<const cli::SimulateAnswer> answer;

  const Trajectory& record() const { return answer->data.trajectories.front(); }
};

SimulatedOrbit simulate(const Arguments& arguments) {
  const Given given(arguments);
  cli::SimulateRequest request;
  take_model(given, request.model);
  take_data(given, request.data);
  given.take("x0", request.x0);
  given.take("t_start", request.t_start);
  given.take("t_end", request.t_end);
  given.take("dt", request.step);
  given.take("input_paths", request.inputs.paths);
  given.take("input_tables", request.inputs.tables);
  given.take("input_time", request.input_time);
  given.take("noise", request.noise);
  given.take("integrator", request.integrator);
  if (given.has("times")) {
    std::vector<double> times;
    given.take("times", times);
    request.times = Eigen::Map<const Vector>(times.data(), static_cast<Index>(times.size()));
  }
  return {answered(given, std::move(request))};
}

std::vector<std::pair<std::string, std::string>> columns_of(const SimulatedOrbit& orbit) {
  std::vector<std::pair<std::string, std::string>> columns;
  for (const Quantity& state : orbit.answer->data.states)
    columns.emplace_back(state.name, state.unit);
  return columns;
}

std::string html_of(const Answer& answer, const std::string& command) {
  Page page = answer.page();
  page.command = command;
  return format_html(page);
}

/// Name and SVG of every picture of the report.
std::vector<std::pair<std::string, std::string>> pictures(const Answer& answer) {
  std::vector<std::pair<std::string, std::string>> result;
  if (!answer.page) return result;
  for (const Picture& picture : pictures_of(answer.page()))
    result.emplace_back(picture.name, stand_alone(picture));
  return result;
}

void bind_orbits(nb::module_& module) {
  nb::class_<SimulatedOrbit>(module, "Orbit", "What was simulated.")
      .def_prop_ro("time",
                   [](const SimulatedOrbit& self) {
                     const Vector& time = self.record().time;
                     return view_of(self, time.data(), time.size());
                   })
      .def_prop_ro("states",
                   [](const SimulatedOrbit& self) {
                     const Matrix& states = self.record().states;
                     return view_of(self, states.data(), states.rows(), states.cols());
                   })
      .def_prop_ro("columns", &columns_of)
      .def_prop_ro("time_unit",
                   [](const SimulatedOrbit& self) { return self.answer->data.time_unit; })
      .def_prop_ro("notes", [](const SimulatedOrbit& self) { return self.answer->notes; })
      .def_prop_ro("problem", [](const SimulatedOrbit& self) { return self.answer->problem; })
      .def("csv", [](const SimulatedOrbit& self) { return format_csv(self.answer->data); });
  module.def("simulate", &simulate, nb::arg("arguments"));
}

}  // namespace

void bind_answers(nb::module_& module) {
  nb::class_<Answer>(module, "Answer", "What a command answers, in the ways it shows it.")
      .def("json", [](const Answer& self) { return self.json ? self.json() : std::string(); })
      .def(
          "text",
          [](const Answer& self, bool full, bool explain) {
            return folded(printable(self.text({{.full = full}, explain})));
          },
          nb::arg("full"), nb::arg("explain"))
      .def("html", &html_of, nb::arg("command"))
      .def("pictures", &pictures)
      .def(
          "figures",
          [](const Answer& self) { return self.page ? figures_of(self.page()) : nb::list(); },
          nb::sig("def figures(self) -> list[dict[str, typing.Any]]"))
      .def_prop_ro("has_page", [](const Answer& self) { return self.page != nullptr; })
      .def_prop_ro("has_json", [](const Answer& self) { return self.json != nullptr; })
      .def("csv", [](const Answer& self) { return self.csv ? self.csv() : std::string(); })
      .def(
          "inputs",
          [](const Answer& self, const std::string& format) {
            return self.inputs ? self.inputs(format) : std::string();
          },
          nb::arg("format"))
      .def_prop_ro("has_trail", [](const Answer& self) { return self.trail != nullptr; })
      .def("trail", [](const Answer& self) { return folded(printable(self.trail())); })
      .def_ro("model", &Answer::model)
      .def_ro("warnings", &Answer::warnings)
      .def_ro("failure", &Answer::failure);
  module.def("identify", &identify, nb::arg("arguments"));
  module.def("diagnose", &diagnose, nb::arg("arguments"));
  module.def("fit", &fit, nb::arg("arguments"));
  module.def("fit_rivals", &fit_rivals, nb::arg("arguments"));
  module.def("sync", &sync, nb::arg("arguments"));
  module.def("compare", &compare, nb::arg("arguments"));
  module.def("check", &check, nb::arg("arguments"));
  bind_orbits(module);
}

}  // namespace lacuna::python
