// SPDX-License-Identifier: MIT
#include "report/pages/fleet_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/json.hpp"
#include "core/base/text.hpp"
#include "diagnosis_sentences.hpp"
#include "folded_text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/report/reports.hpp"

namespace lacuna {
namespace {

using Json = nlohmann::ordered_json;

/// How many records have each effect, most frequent first.
std::vector<std::pair<std::string, std::size_t>> counted(
    const std::vector<FleetAnswer>& answers) {
  std::map<std::string, std::size_t> counts;
  for (const FleetAnswer& answer : answers) {
    std::vector<std::string> effects = answer.effects;
    std::sort(effects.begin(), effects.end());
    effects.erase(std::unique(effects.begin(), effects.end()), effects.end());
    for (const std::string& effect : effects) ++counts[effect];
  }
  std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return sorted;
}

/// "0.41 -> 0.052", of the model and with the effects; empty where it was not gauged.
std::string gap_text(const FleetAnswer& answer) {
  if (!answer.gap) return "";
  return format_number((*answer.gap)[0], 3) + " -> " + format_number((*answer.gap)[1], 3);
}

std::vector<std::string> row_of(const FleetAnswer& answer) {
  if (answer.error) return {answer.record, "error", *answer.error, ""};
  return {answer.record, answer.verdict,
          answer.effects.empty() ? "-" : join(answer.effects, ", "), gap_text(answer)};
}

Json json_of(const FleetAnswer& answer) {
  if (answer.error)
    return {{"record", answer.record},
            {"headline", nullptr},
            {"error", *answer.error},
            {"diagnosis", nullptr}};
  return {{"record", answer.record},
          {"headline", answer.headline},
          {"error", nullptr},
          {"diagnosis", ordered_json(answer.diagnosis)}};
}

}  // namespace

FleetAnswer fleet_answer(const std::string& record, const Diagnosis& diagnosis) {
  FleetAnswer answer{.record = record,
                     .headline = sentences_of(diagnosis).headline,
                     .verdict = to_string(diagnosis.verdict),
                     .diagnosis = format_json(diagnosis)};
  if (diagnosis.admission.stands())  // without a verdict effects are candidates, no findings
    for (const NamedEffect& effect : diagnosis.effects)
      answer.effects.push_back(
          effect.name + " in " +
          diagnosis.nominal.states()[static_cast<std::size_t>(effect.equation)].name);
  const auto& gap = diagnosis.gap;
  if (gap && std::isfinite(gap->before) && std::isfinite(gap->after))
    answer.gap = {gap->before, gap->after};
  return answer;
}

FleetAnswer fleet_failure(const std::string& record, const std::string& error) {
  return {.record = record, .error = error};
}

std::string packed(const FleetAnswer& answer) {
  if (answer.error) return json_line(Json::array({answer.record, *answer.error}));
  const Json gap = answer.gap ? Json(*answer.gap) : Json();
  return json_line(Json::array(
      {answer.record, answer.headline, answer.verdict, answer.effects, gap, answer.diagnosis}));
}

FleetAnswer unpacked(const std::string& text) {
  try {
    const Json all = ordered_json(text);
    if (all.size() == 2) return fleet_failure(all.at(0), all.at(1));
    FleetAnswer answer{.record = all.at(0),
                       .headline = all.at(1),
                       .verdict = all.at(2),
                       .effects = all.at(3),
                       .diagnosis = all.at(5)};
    if (!all.at(4).is_null()) answer.gap = all.at(4).get<std::array<double, 2>>();
    return answer;
  } catch (const nlohmann::json::exception&) {
    throw ArgumentError("answer of a fleet", "the text is none", "give what packed() made");
  }
}

std::string format_text(const std::vector<FleetAnswer>& fleet) {
  std::vector<std::vector<std::string>> rows{{"record", "verdict", "effects", "gap"}};
  for (const FleetAnswer& answer : fleet) rows.push_back(row_of(answer));
  std::vector<std::vector<std::string>> effects{{"effect", "records"}};
  for (const auto& [effect, count] : counted(fleet))
    effects.push_back({effect, std::to_string(count) + " of " + std::to_string(fleet.size())});
  std::string text = "Answers\n" + text_table(rows);
  if (effects.size() > 1) text += "\nEffects\n" + text_table(effects);
  return text;
}

std::string format_json(const std::vector<FleetAnswer>& fleet) {
  Json answers = Json::array(), effects = Json::array();
  for (const FleetAnswer& answer : fleet) answers.push_back(json_of(answer));
  for (const auto& [effect, count] : counted(fleet))
    effects.push_back({{"effect", effect}, {"records", count}});
  const Json fleet_json = {
      {"format", "lacuna.fleet/1"}, {"answers", answers}, {"effects", effects}};
  return json_lines(fleet_json, 1);
}

}  // namespace lacuna
