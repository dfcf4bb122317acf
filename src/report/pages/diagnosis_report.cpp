// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/json.hpp"
#include "core/statistics/determined.hpp"
#include "diagnosis_sentences.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/report/reports.hpp"
#include "report/json/adequacy_json.hpp"
#include "report/json/stages_json.hpp"

namespace lacuna {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Location& place) {
  Json json;
  if (place.frequency) {
    json["frequency"] = *place.frequency;
  } else {
    json["variable"] = place.variable;
    json["range"] = {place.low, place.high};
  }
  json["sigma"] = place.sigma;
  return json;
}

/// A number whose error is not known has no interval, and none of width 0, nor one that says
/// nothing of it.
Json interval_json(double estimate, const std::array<double, 2>& ends) {
  const double half = ends[1] / 2.0 - ends[0] / 2.0;
  return half > 0.0 && is_determined(estimate, half) ? Json(ends) : Json();
}

Json disagreement_json(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const Disagreement& entry : diagnosis.disagreement) {
    Json json{{"equation", state_name(diagnosis, entry.equation)},
              {"rms", entry.rms},
              {"noise_floor", entry.noise_floor},
              {"sigma", entry.sigma},
              {"share", entry.fraction},
              {"relative", entry.relative},
              {"where", Json::array()}};
    for (const Location& place : entry.where) json["where"].push_back(to_json(place));
    list.push_back(std::move(json));
  }
  return list;
}

/// Names that the records do not distinguish from an effect.
Json twins_json(const Diagnosis& diagnosis, const NamedEffect& effect) {
  std::vector<std::string> names;
  for (const Twin& twin : diagnosis.twins)
    for (const std::string& name : twin.names)
      if ((twin.instead_of.empty() || twin.instead_of == effect.name) &&
          std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
  return names;
}

/// Whether a fault of a channel and an effect of the dynamics are not distinguished.
bool is_dynamics_or_measurement(const Diagnosis& diagnosis) {
  const auto is_fault = [](const NamedEffect& one) { return one.place == Place::Channel; };
  const auto& effects = diagnosis.effects;
  const bool fault = std::any_of(effects.begin(), effects.end(), is_fault);
  return std::any_of(
      diagnosis.twins.begin(), diagnosis.twins.end(),
      [&](const Twin& twin) { return fault || twin.measurement; });
}

/// What would have been seen; null where the verdict is not that nothing is determined, or that
/// is not known either.
Json smallest_effect_json(const Diagnosis& diagnosis) {
  if (diagnosis.smallest_effects.empty()) return {};
  Json list = Json::array();
  for (const SmallestEffect& least : diagnosis.smallest_effects)
    list.push_back({{"equation", state_name(diagnosis, least.equation)},
                    {"rate", least.rate},
                    {"relative", least.relative}});
  return list;
}

Json to_json(const Diagnosis& diagnosis, const NamedEffect& effect) {
  Json json{{"equation", state_name(diagnosis, effect.equation)},
            {"name", effect.name},
            {"description", effect.description},
            {"cause", effect.cause},
            {"term", effect.term},
            {"coefficient", effect.coefficient},
            {"ci95", interval_json(effect.coefficient, effect.ci95())},
            {"parameters", Json::object()},
            {"sigma", effect.sigma},
            {"gap_closed", effect.gap_closed},
            {"contribution", effect.contribution},
            {"probability", effect.probability},
            {"claim", diagnosis.verdict == Verdict::Explained},
            {"not_told_apart", twins_json(diagnosis, effect)},
            {"alternatives", Json::array()}};
  for (const NamedParameter& parameter : effect.parameters)
    json["parameters"][parameter.name] = parameter.value;
  for (const Alternative& other : effect.alternatives)
    json["alternatives"].push_back(
        {{"name", other.name}, {"term", other.term}, {"probability", other.probability}});
  return json;
}

/// As effects, none of them claimed.
Json minor_json(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const NamedEffect& effect : diagnosis.minor_effects) {
    list.push_back(to_json(diagnosis, effect));
    list.back()["claim"] = false;
  }
  return list;
}

Json changes_json(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const CoefficientChange& change : diagnosis.coefficient_changes) {
    list.push_back({{"equation", state_name(diagnosis, change.equation)},
                    {"term", change.term},
                    {"nominal", change.nominal},
                    {"estimated", change.estimated},
                    {"ci95", interval_json(change.estimated, change.ci95())},
                    {"sigma", change.sigma}});
    if (!change.determined) list.back()["ci95"] = nullptr;
  }
  return list;
}

Json combined_json(const Diagnosis& diagnosis) {
  if (!diagnosis.combined_change) return {};
  const CombinedChange& change = *diagnosis.combined_change;
  return {{"equation", state_name(diagnosis, change.equation)},
          {"terms", {change.first, change.second}},
          {"weights", {1.0, change.weight}},
          {"nominal", change.nominal},
          {"estimated", change.estimated},
          {"ci95", interval_json(change.estimated, change.ci95())},
          {"sigma", change.sigma}};
}

Json free_run_json(const Gap& gap) {
  if (!gap.free_after) return {};
  const auto apart = [](const std::optional<RunApart>& run) {
    return run && std::isfinite(run->apart) ? Json(run->apart) : Json();
  };
  return {{"before", apart(gap.free_before)},
          {"after", apart(gap.free_after)},
          {"time", gap.free_after->duration}};
}

Json gap_json(const Gap& gap) {
  return {{"metric", gap.metric},
          {"before", gap.before},
          {"after", gap.after},
          {"noise_floor", gap.noise_floor},
          {"above_floor", gap.above_floor},
          {"ratio", gap.ratio()},
          {"window", gap.window},
          {"free_run", free_run_json(gap)},
          {"records", gap.records}};
}

Json remaining_json(const Diagnosis& diagnosis) {
  Json json{{"structure", diagnosis.remaining.structure},
            {"sigma", diagnosis.remaining.sigma},
            {"equations", Json::array()}};
  for (const Index equation : diagnosis.remaining.equations)
    json["equations"].push_back(state_name(diagnosis, equation));
  return json;
}

Json noise_json(const Diagnosis& diagnosis) {
  Json json = Json::object();
  for (std::size_t k = 0; k < diagnosis.noise.measurement.size(); ++k) {
    const auto& white = diagnosis.noise.measurement[k];
    if (white && k < diagnosis.nominal.states().size())
      json[diagnosis.nominal.states()[k].name] = diagnosis.noise.rounded(k);
  }
  return json;
}

Json rounds_json(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const Round& round : diagnosis.rounds)
    list.push_back({{"tried", round.tried},
                    {"best", round.best},
                    {"sigma", round.sigma},
                    {"accepted", round.accepted}});
  return list;
}

Json rivals_json(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const Rival& rival : diagnosis.rivals)
    list.push_back({{"hypothesis", rival.hypothesis},
                    {"account", rival.composite},
                    {"criterion", rival.criterion ? Json(*rival.criterion) : Json()},
                    {"taken", rival.taken},
                    {"quantity", rival.quantity},
                    {"value", rival.value},
                    {"threshold", rival.threshold},
                    {"rule", rival.rule}});
  return list;
}

Json hints_json(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const Hint& hint : diagnosis.hints)
    list.push_back(
        {{"kind", to_string(hint.kind)}, {"message", hint.message}, {"remedy", hint.remedy}});
  return list;
}

Json unnamed_json(const Diagnosis& diagnosis) {
  if (!diagnosis.unnamed) return {};
  const Unnamed& unnamed = *diagnosis.unnamed;
  return {{"equation", state_name(diagnosis, unnamed.equation)},
          {"variables", unnamed.variables},
          {"explained", unnamed.explained},
          {"memory", unnamed.memory},
          {"periodic", unnamed.periodic},
          {"stop_gap", unnamed.filled},
          {"formula", unnamed.formula.empty() ? Json() : Json(unnamed.formula)}};
}

/// Why the search's verdict is not given; null where it is.
Json why_json(const Diagnosis& diagnosis) {
  return diagnosis.admission.stands() ? Json() : Json(diagnosis.admission.why);
}

}  // namespace

std::string format_json(const Diagnosis& diagnosis) {
  return format_json(diagnosis, diagnosis.augmented);
}

std::string format_json(const Diagnosis& diagnosis, const SystemModel& augmented) {
  Json json{{"format", "lacuna.diagnosis/1"},
            {"verdict", to_string(diagnosis.verdict)},
            {"why", why_json(diagnosis)},
            {"smallest_effect", smallest_effect_json(diagnosis)},
            {"dynamics_or_measurement", is_dynamics_or_measurement(diagnosis)},
            {"hints", hints_json(diagnosis)},
            {"disagreement", disagreement_json(diagnosis)},
            {"effects", Json::array()}};
  for (const NamedEffect& effect : diagnosis.effects)
    json["effects"].push_back(to_json(diagnosis, effect));
  json["minor_effects"] = minor_json(diagnosis);
  json["coefficient_changes"] = changes_json(diagnosis);
  json["combined_change"] = combined_json(diagnosis);
  json["adequacy"] = adequacy_json(diagnosis.adequacy);
  json["gap"] = diagnosis.gap ? gap_json(*diagnosis.gap) : Json();
  json["remaining"] = remaining_json(diagnosis);
  json["unnamed"] = unnamed_json(diagnosis);
  json["augmented_model"] = ordered_json(format_model(augmented));
  json["noise"] = noise_json(diagnosis);
  json["rounds"] = rounds_json(diagnosis);
  json["rivals"] = rivals_json(diagnosis);
  json["stages"] = stages_json(diagnosis.stages);
  json["answer_from"] = answer_from(diagnosis.stages);
  json["notes"] = diagnosis.notes;
  return json_lines(json);
}

}  // namespace lacuna
