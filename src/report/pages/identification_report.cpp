// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "core/base/json.hpp"
#include "invariant_text.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/report/reports.hpp"
#include "report/json/adequacy_json.hpp"
#include "report/json/stage_json.hpp"
#include "report/json/stages_json.hpp"
#include "report/json/sync_json.hpp"

namespace lacuna {
namespace {

using Json = nlohmann::ordered_json;

Json noise_to_json(const IdentificationResult& result) {
  Json noise = Json::object();
  for (Index k = 0; k < result.noise.size(); ++k)
    noise[result.model.states()[static_cast<std::size_t>(k)].name] = result.noise[k];
  return noise;
}

Json entry_to_json(const TrailEntry& entry) {
  Json json{{"equation", entry.equation}, {"term", entry.term}, {"kept", entry.kept}};
  if (!entry.kept) json["removed_by"] = entry.stage;
  json["quantity"] = entry.quantity;
  json["value"] = entry.value;
  if (entry.kept) return json;
  json["threshold"] = entry.threshold;
  json["step"] = entry.step;
  return json;
}

template <class T>
Json optional_to_json(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json fit_to_json(const EquationFit& fit) {
  if (fit.identity) return {{"equation", fit.equation}, {"identity", true}};
  Json json{{"equation", fit.equation}, {"identity", false}, {"rows", fit.rows}};
  json["residual"] = fit.residual_rms;
  json["target"] = fit.target_rms;
  json["noise_floor"] = optional_to_json(fit.noise_floor);
  json["misfit"] = optional_to_json(fit.misfit);
  json["fits_to_noise"] = optional_to_json(fit.fits_to_noise);
  json["converged"] = fit.converged;
  json["iterations"] = fit.iterations;
  return json;
}

Json step_to_json(const IdentificationResult& result, const PathStep& step) {
  return {{"equation", result.model.states()[static_cast<std::size_t>(step.equation)].name},
          {"term", step.term},
          {"terms", step.terms},
          {"in_model", step.in_model},
          {"gain", step.gain},
          {"price", step.penalty}};
}

template <class T, class Convert>
Json list_to_json(const std::vector<T>& values, Convert convert) {
  Json list = Json::array();
  for (const T& value : values) list.push_back(convert(value));
  return list;
}

Json error_to_json(const PredictionError& error) {
  return {{"state", error.state},     {"error", error.error},
          {"noise", error.noise},     {"noise_seen", error.noise_estimated},
          {"motion", error.motion},   {"share", error.fraction()},
          {"freedom", error.freedom}, {"correlation", error.correlation}};
}

Json test_to_json(const PredictionTest& test) {
  return {{"horizon", test.horizon},
          {"windows", test.windows},
          {"without_solution", test.lost},
          {"without_start", test.unstarted},
          {"states", list_to_json(test.states, error_to_json)}};
}

Json validation_to_json(const Validation& validation) {
  return {{"verdict", to_string(validation.verdict)},
          {"sentence", validation.sentence},
          {"held_out", validation.given ? "records" : "parts"},
          {"records", validation.records},
          {"samples", validation.samples},
          {"refitted", validation.refitted},
          {"one_step", test_to_json(validation.one_step)},
          {"windows", test_to_json(validation.windows)},
          {"advice", validation.advice}};
}

Json relation_to_json(const Relation& relation) {
  // The first, to which the others are relative, has no error, and neither have exact ones.
  const auto term_to_json = [](const RelationTerm& term) {
    Json json{{"term", term.term}, {"coefficient", term.coefficient}, {"stderr", nullptr}};
    if (term.error > 0.0) json["stderr"] = term.error;
    return json;
  };
  return {{"terms", list_to_json(relation.terms, term_to_json)},
          {"value", relation.value},
          {"scatter", relation.scatter},
          {"noise", relation.noise},
          {"sentence", relation_sentence(relation)}};
}

Json dead_time_to_json(const DeadTime& late) {
  Json json{{"input", late.input},
            {"time", late.time},
            {"stderr", optional_to_json(late.standard_error)},
            {"ci95", nullptr}};
  if (late.ci95) json["ci95"] = *late.ci95;
  return json;
}

Json numbers_to_json(const Vector& values) {
  return std::vector<double>(values.begin(), values.end());
}

Json trapping_to_json(const TrappingAnswer& answer) {
  constexpr std::array kVerdicts{"trapped", "not-quadratic", "produces-energy", "no-centre"};
  Json json{{"verdict", kVerdicts[static_cast<std::size_t>(answer.verdict)]},
            {"region", nullptr}};
  if (const auto& region = answer.region)
    json["region"] = {{"centre", numbers_to_json(region->centre)},
                      {"weights", numbers_to_json(region->weights)},
                      {"radius", region->radius},
                      {"decay", region->decay}};
  return json;
}

Json alternative_to_json(const AlternativeModel& alternative) {
  return {{"model", ordered_json(format_model(alternative.model))},
          {"criterion", alternative.criterion},
          {"weight", alternative.weight},
          {"held_out_error", optional_to_json(alternative.held_out)},
          {"without", alternative.without},
          {"with", alternative.with}};
}

}  // namespace

std::string format_json(const IdentificationReport& report) {
  const IdentificationResult& result = report.result;
  Json json;
  json["format"] = "lacuna.identification/1";
  json["model"] = ordered_json(format_model(result.model));
  json["library_alone"] =
      result.library_alone ? ordered_json(format_model(*result.library_alone)) : Json(nullptr);
  json["dead_times"] = list_to_json(result.dead_times, dead_time_to_json);
  json["noise"] = noise_to_json(result);
  json["pipeline"] = {{"asked", ordered_json(report.asked)},
                      {"used", ordered_json(format_pipeline(report.pipeline))}};
  json["trail"] = list_to_json(result.trail, entry_to_json);
  json["fit"] = list_to_json(result.fit, fit_to_json);
  json["path"] = list_to_json(result.path,
                              [&](const PathStep& step) { return step_to_json(result, step); });
  json["adequacy"] = adequacy_json(result.adequacy);
  json["verdict"] =
      result.validation ? Json(to_string(result.validation->verdict)) : Json(nullptr);
  json["validation"] =
      result.validation ? validation_to_json(*result.validation) : Json(nullptr);
  json["relations"] = list_to_json(result.relations, relation_to_json);
  json["trapping"] = trapping_to_json(result.trapping);
  if (report.alternatives)
    json["alternatives"] = list_to_json(*report.alternatives, alternative_to_json);
  json["sync"] = report.sync ? sync_to_json(*report.sync) : Json(nullptr);
  json["stages"] = stages_json(result.stages);
  json["answer_from"] = answer_from(result.stages);
  json["warnings"] = result.warnings;
  return json_lines(json);
}

}  // namespace lacuna
