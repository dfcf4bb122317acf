// SPDX-License-Identifier: MIT
#include <memory>

#include "answers.hpp"
#include "cli/configuration/description.hpp"
#include "command.hpp"
#include "core/base/text.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "report/json/stage_json.hpp"

namespace lacuna::cli {
namespace {

std::string format_preset(const Preset& preset) {
  return preset.name + " (preset)\n  " + preset.summary + "\n  Source: " + preset.reference +
         "\nConfiguration:\n  " + format_pipeline(preset.make(Tolerances::Repaired)) + "\n";
}

std::string format_system(const TestSystem& system) {
  std::vector<std::string> start;
  for (const double value : system.start) start.push_back(format_number(value));
  return system.name + " (system)\n  " + system.summary + "\n  Source: " + system.reference +
         "\n  Start: " + join(start, ",") + "; step " + format_number(system.step) + " " +
         system.model.time_unit() + "\nEquations:\n" + to_text(system.model) + "\n";
}

std::vector<std::string> all_names(const Registry& registry) {
  std::vector<std::string> names;
  for (const RegistryEntry& entry : registry.entries()) names.emplace_back(entry.info.name);
  for (const Preset& preset : presets()) names.push_back(preset.name);
  for (const TestSystem& system : test_systems()) names.push_back(system.name);
  for (const auto& [name, summary] : exports()) names.push_back(name);
  return names;
}

}  // namespace

std::string description_of(const Registry& registry, const std::string& name) {
  std::vector<std::string> found;
  for (const RegistryEntry& entry : registry.entries())
    if (entry.info.name == name) found.push_back(format_description(entry));
  for (const Preset& preset : presets())
    if (preset.name == name) found.push_back(format_preset(preset));
  for (const TestSystem& system : test_systems())
    if (system.name == name) found.push_back(format_system(system));
  if (const auto format = exports().find(name); format != exports().end())
    found.push_back(name + " (export)\n  " + format->second + "\n");
  if (found.empty())
    throw ConfigError("describe " + name, "there is no part called '" + name + "'",
                      suggestion(name, all_names(registry)));
  return join(found, "\n");
}

Command declare_describe() {
  auto name = std::make_shared<std::string>();
  Command command{"describe",
                  "Show the options of a part with units, ranges, defaults and source"};
  command.add("NAME", name.get(), "Name of a part, a preset or a test system").require();
  command.run = [name](const Session& session) {
    show(session, description_of(session.registry, *name));
    return 0;
  };
  return command;
}

}  // namespace lacuna::cli
