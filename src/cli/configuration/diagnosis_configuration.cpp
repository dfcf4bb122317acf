// SPDX-License-Identifier: MIT
#include "cli/configuration/diagnosis_configuration.hpp"

#include "core/base/json.hpp"
#include "core/base/text.hpp"
#include "option_reader.hpp"

namespace lacuna {
namespace {

const std::vector<std::string> kKeys = {"decision", "criterion", "hypotheses", "effects",
                                        "fill_gap"};

void check_diagnosis_keys(const Json& root) {
  for (const auto& [key, value] : root.items())
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end())
      throw ConfigError("$." + key, "a diagnosis has no key '" + key + "'",
                        suggestion(key, kKeys));
}

/// The names in a list of the configuration. @param known for the message.
std::vector<std::string> names_in(const Json& list, const std::string& key,
                                  const std::vector<std::string>& known) {
  const auto is_text = [](const Json& name) { return name.is_string(); };
  if (!list.is_array() || !std::all_of(list.begin(), list.end(), is_text))
    throw ConfigError("$." + key, json_line(list) + " is not a list of names",
                      "give a list, e.g. " + key + "=[\"" + known.front() + "\"]");
  return list.get<std::vector<std::string>>();
}

template <class Interface>
std::vector<Stage<Interface>> stages(const Registry& registry, const Json& root,
                                     const std::string& key) {
  if (!root.contains(key)) return registry.make_all<Interface>();
  std::vector<Stage<Interface>> result;
  for (const std::string& name : names_in(root.at(key), key, registry.names(Interface::kKind)))
    result.push_back(registry.make<Interface>(name));
  return result;
}

}  // namespace

DiagnosisOptions diagnosis_options(const Configuration& configuration,
                                   const Registry& registry) {
  const Json root = sorted_json(configuration.text());
  check_diagnosis_keys(root);
  DiagnosisOptions options;
  options.effects = stages<Effect>(registry, root, "effects");
  options.hypotheses = stages<Hypothesis>(registry, root, "hypotheses");
  if (root.contains("criterion"))
    options.criterion = Stage<Criterion>(std::dynamic_pointer_cast<const Criterion>(read_stage(
        registry, Criterion::kKind, root.at("criterion"), "$.criterion", *options.criterion)));
  if (root.contains("decision")) {
    const auto rules = std::dynamic_pointer_cast<const StandardDecision>(
        read_stage(registry, DecisionRules::kKind, root.at("decision"), "$.decision",
                   StandardDecision(options.decision)));
    options.decision = rules->options();
  }
  if (root.contains("fill_gap")) {
    if (!root.at("fill_gap").is_boolean())
      throw ConfigError("$.fill_gap", json_line(root.at("fill_gap")) + " is not true or false",
                        "give true or false");
    options.fill_gap = root.at("fill_gap").get<bool>();
  }
  return options;
}

}  // namespace lacuna
