// SPDX-License-Identifier: MIT
#include <fstream>
#include <nlohmann/json.hpp>

#include "systems.hpp"

namespace lacuna::hidden_states {
namespace {

using Json = nlohmann::json;

Kind kind_of(const std::string& name) {
  if (name == "effect") return Kind::Effect;
  return name == "null" ? Kind::Null : Kind::Undetermined;
}

System system_of(const Json& json) {
  return {.name = json["name"],
          .kind = kind_of(json["kind"]),
          .truth = json["truth"],
          .nominal = json["nominal"],
          .measured = json["measured"],
          .start = json["start"],
          .step = json["step"],
          .samples = json["samples"],
          .low = json["input"][0],
          .high = json["input"][1],
          .period = json["input"][2],
          .equations = json["equations"],
          .names = json["names"]};
}

}  // namespace

std::vector<System> all_systems() {
  std::vector<System> systems;
  for (const Json& json : Json::parse(std::ifstream(LACUNA_HIDDEN_STATES)))
    systems.push_back(system_of(json));
  return systems;
}

}  // namespace lacuna::hidden_states
