// SPDX-License-Identifier: MIT
// The models that an earlier answer leaves possible.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "core/base/json.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "model/files/strict_json.hpp"
#include "plan_request.hpp"

namespace lacuna::cli {
namespace {

using Json = nlohmann::json;

SystemModel model_in(const Json& answer, const char* key, const std::string& source) {
  return parse_system(json_line(answer.at(key)), source + ": $." + key);
}

/// The noise of channels: residuals of a fit are no smaller.
PlanModels of_fit(const Json& answer, const std::string& source) {
  PlanModels found;
  found.models.push_back({"fit", model_in(answer, "model", source)});
  for (const Json& channel : answer.at("fit"))
    if (channel.at("rmse").is_number() && channel.at("rmse").get<double>() > 0.0)
      found.channels.push_back(
          {channel.at("channel").get<std::string>(), channel.at("rmse").get<double>()});
  return found;
}

/// The structures that are tied, by their files.
PlanModels of_rivals(const Json& answer) {
  PlanModels found;
  for (const Json& rival : answer.at("rivals"))
    if (rival.at("tied").get<bool>()) {
      const auto path = rival.at("model").get<std::string>();
      found.models.push_back({path, load_system({path})});
    }
  return found;
}

/// The model with another term in the place of one; nothing where that is not there.
std::optional<SystemModel> with_other_term(const SystemModel& system, const std::string& state,
                                           const std::string& term, const std::string& other) {
  const OdeModel& symbolic = system.symbolic();
  const auto k = static_cast<std::size_t>(symbolic.state_index(state));
  std::vector<Equation> equations = symbolic.equations();
  const auto place =
      std::find_if(equations[k].begin(), equations[k].end(),
                   [&](const WeightedTerm& one) { return one.term.name() == term; });
  if (place == equations[k].end()) return std::nullopt;
  *place = {Term::parse(other, symbolic.variables()), place->coefficient};
  return SystemModel(symbolic.with_equations(std::move(equations)), system.parameters());
}

/// The model with all that is missing, and each alternative of each effect in its place.
PlanModels of_diagnosis(const Json& answer, const std::string& source) {
  PlanModels found;
  const SystemModel augmented = model_in(answer, "augmented_model", source);
  std::string name = "model";
  for (const Json& effect : answer.at("effects"))
    name = name == "model" ? effect.at("name").get<std::string>()
                           : name + "+" + effect.at("name").get<std::string>();
  found.models.push_back({name, augmented});
  for (const Json& effect : answer.at("effects"))
    for (const Json& other : effect.at("alternatives")) {
      const auto model = with_other_term(augmented, effect.at("equation").get<std::string>(),
                                         effect.at("term").get<std::string>(),
                                         other.at("term").get<std::string>());
      if (!model) continue;
      const Json& probability = other.at("probability");
      constexpr double kLeast = 1e-3;  // a decision: what was ruled out once may be right
      const double weight = probability.is_number() ? probability.get<double>() : 0.0;
      found.models.push_back({other.at("name").get<std::string>(), *model, {},
                              std::max(weight, kLeast)});
      found.has_unfitted = true;
    }
  return found;
}

PlanModels of_identification(const Json& answer, const std::string& source) {
  PlanModels found;
  found.models.push_back({"identified", model_in(answer, "model", source)});
  if (answer.contains("library_alone") && !answer.at("library_alone").is_null())
    found.models.push_back({"library-alone", model_in(answer, "library_alone", source)});
  for (const auto& [state, noise] : answer.at("noise").items())
    if (noise.is_number() && noise.get<double>() > 0.0)
      found.channels.push_back({state, noise.get<double>()});
  return found;
}

constexpr const char* kAnswerRemedy = "give what fit, diagnose or identify wrote with --json";

Json parsed_answer(const std::string& text, const std::string& source) {
  try {
    return parse_strict_json(text, "--after " + source);
  } catch (const ModelError& error) {
    throw ConfigError(error.where(), "it is no answer as JSON: " + error.problem(),
                      kAnswerRemedy);
  }
}

}  // namespace

PlanModels models_of_answer(const std::string& text, const std::string& source) {
  try {
    const Json answer = parsed_answer(text, source);
    const auto format = answer.at("format").get<std::string>();
    if (format == "lacuna.fit/1") return of_fit(answer, source);
    if (format == "lacuna.rivals/1") return of_rivals(answer);
    if (format == "lacuna.diagnosis/1") return of_diagnosis(answer, source);
    if (format == "lacuna.identification/1") return of_identification(answer, source);
    throw ConfigError("--after " + source, "its format is '" + format + "'", kAnswerRemedy);
  } catch (const Json::exception&) {
    throw ConfigError("--after " + source, "it is no answer as JSON", kAnswerRemedy);
  }
}

}  // namespace lacuna::cli
