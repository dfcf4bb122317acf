// SPDX-License-Identifier: MIT
#include "report/pages/fleet_report.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/text.hpp"
#include "diagnosis_sentences.hpp"
#include "lacuna/report/pages/diagnosis_report.hpp"
#include "text_table.hpp"

namespace lacuna {
namespace {

using Json = nlohmann::ordered_json;

std::vector<Json> parsed(const std::vector<FleetAnswer>& fleet) {
  std::vector<Json> answers;
  for (const FleetAnswer& answer : fleet) answers.push_back(Json::parse(answer.json));
  return answers;
}

/// "coulomb-friction in dw/dt" of each effect of an answer.
std::vector<std::string> effects_of(const Json& answer) {
  std::vector<std::string> effects;
  if (answer["diagnosis"].is_null()) return effects;
  for (const Json& effect : answer["diagnosis"]["effects"])
    effects.push_back(effect["name"].get<std::string>() + " in " +
                      effect["equation"].get<std::string>());
  return effects;
}

/// How many records have each effect, most frequent first.
std::vector<std::pair<std::string, std::size_t>> counted(const std::vector<Json>& answers) {
  std::map<std::string, std::size_t> counts;
  for (const Json& answer : answers) {
    std::vector<std::string> effects = effects_of(answer);
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
std::string gap_text(const Json& diagnosis) {
  const Json& gap = diagnosis["gap"];
  if (gap.is_null() || gap["before"].is_null() || gap["after"].is_null()) return "";
  return format_number(gap["before"].get<double>(), 3) + " -> " +
         format_number(gap["after"].get<double>(), 3);
}

std::vector<std::string> row_of(const Json& answer) {
  const auto record = answer["record"].get<std::string>();
  if (answer["diagnosis"].is_null())
    return {record, "error", answer["error"].get<std::string>(), ""};
  const std::vector<std::string> effects = effects_of(answer);
  return {record, answer["diagnosis"]["verdict"].get<std::string>(),
          effects.empty() ? "-" : join(effects, ", "), gap_text(answer["diagnosis"])};
}

}  // namespace

FleetAnswer fleet_answer(const std::string& record, const Diagnosis& diagnosis) {
  const Json answer = {{"record", record},
                       {"headline", sentences_of(diagnosis).headline},
                       {"error", nullptr},
                       {"diagnosis", Json::parse(format_json(diagnosis))}};
  return {answer.dump()};
}

FleetAnswer fleet_failure(const std::string& record, const std::string& error) {
  const Json answer = {
      {"record", record}, {"headline", nullptr}, {"error", error}, {"diagnosis", nullptr}};
  return {answer.dump()};
}

std::string format_text(const std::vector<FleetAnswer>& fleet) {
  const std::vector<Json> answers = parsed(fleet);
  std::vector<std::vector<std::string>> rows{{"record", "verdict", "effects", "gap"}};
  for (const Json& answer : answers) rows.push_back(row_of(answer));
  std::vector<std::vector<std::string>> effects{{"effect", "records"}};
  for (const auto& [effect, count] : counted(answers))
    effects.push_back({effect, std::to_string(count) + " of " + std::to_string(fleet.size())});
  std::string text = "Answers\n" + text_table(rows);
  if (effects.size() > 1) text += "\nEffects\n" + text_table(effects);
  return text;
}

std::string format_json(const std::vector<FleetAnswer>& fleet) {
  Json answers = Json::array(), effects = Json::array();
  const std::vector<Json> all = parsed(fleet);
  for (const Json& answer : all) answers.push_back(answer);
  for (const auto& [effect, count] : counted(all))
    effects.push_back({{"effect", effect}, {"records", count}});
  const Json fleet_json = {
      {"format", "lacuna.fleet/1"}, {"answers", answers}, {"effects", effects}};
  return fleet_json.dump(1) + "\n";
}

}  // namespace lacuna
