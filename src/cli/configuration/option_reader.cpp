// SPDX-License-Identifier: MIT
#include "option_reader.hpp"

#include <algorithm>

#include "core/base/json.hpp"
#include "core/base/text.hpp"
#include "report/json/stage_json.hpp"

namespace lacuna {

OptionReader::OptionReader(const Registry& registry, Json base, const Json& given,
                           std::string path)
    : registry_(registry), base_(std::move(base)), given_(given), path_(std::move(path)) {}

const Json* OptionReader::find(const FieldInfo& info) {
  const std::string name(info.name);
  known_.push_back(name);
  if (given_.contains(name)) return &given_.at(name);
  return base_.contains(name) ? &base_.at(name) : nullptr;
}

std::string OptionReader::path_of(const FieldInfo& info) const {
  return path_ + "." + std::string(info.name);
}

void OptionReader::wrong_type(const FieldInfo& info, const std::string& expected,
                              const Json& value) const {
  throw ConfigError(path_of(info), json_line(value) + " is not " + expected,
                    "give " + expected);
}

double OptionReader::number(const FieldInfo& info, const Json& value) const {
  if (!value.is_number()) wrong_type(info, "a number", value);
  const double result = value.get<double>();
  check_range(path_, info, result);
  return result;
}

int OptionReader::integer(const FieldInfo& info, const Json& value) const {
  const double result = value.is_number() ? value.get<double>() : 0.5;
  if (result != static_cast<double>(static_cast<int>(std::clamp(result, -1e9, 1e9))))
    wrong_type(info, "a whole number", value);
  check_range(path_, info, result);
  return static_cast<int>(result);
}

void OptionReader::field(const FieldInfo& info, double& value) {
  if (const Json* given = find(info)) value = number(info, *given);
}

void OptionReader::field(const FieldInfo& info, int& value) {
  if (const Json* given = find(info)) value = integer(info, *given);
}

void OptionReader::field(const FieldInfo& info, bool& value) {
  const Json* given = find(info);
  if (given == nullptr) return;
  if (!given->is_boolean()) wrong_type(info, "true or false", *given);
  value = given->get<bool>();
}

void OptionReader::field(const FieldInfo& info, std::string& value) {
  const Json* given = find(info);
  if (given == nullptr) return;
  if (!given->is_string()) wrong_type(info, "a text", *given);
  value = given->get<std::string>();
}

void OptionReader::field(const FieldInfo& info, std::optional<double>& value) {
  const Json* given = find(info);
  if (given == nullptr) return;
  value = given->is_null() ? std::nullopt : std::optional(number(info, *given));
}

void OptionReader::field(const FieldInfo& info, std::optional<int>& value) {
  const Json* given = find(info);
  if (given == nullptr) return;
  value = given->is_null() ? std::nullopt : std::optional(integer(info, *given));
}

void OptionReader::field(const FieldInfo& info, std::vector<std::string>& value) {
  const Json* given = find(info);
  if (given == nullptr) return;
  const auto is_text = [](const Json& entry) { return entry.is_string(); };
  if (given->is_string()) {
    value = split_list(given->get<std::string>());
  } else if (given->is_number()) {
    value = {json_line(*given)};
  } else if (given->is_array() && std::all_of(given->begin(), given->end(), is_text)) {
    value = given->get<std::vector<std::string>>();
  } else {
    wrong_type(info, "a list of texts", *given);
  }
}

void OptionReader::choice(const FieldInfo& info, std::span<const std::string_view> names,
                          int& index) {
  const Json* given = find(info);
  if (given == nullptr) return;
  if (!given->is_string()) wrong_type(info, "a text", *given);
  const std::string name = given->get<std::string>();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw ConfigError(path_of(info), "there is no choice '" + name + "'",
                      suggestion(name, std::vector<std::string>(names.begin(), names.end())));
  index = static_cast<int>(found - names.begin());
}

void OptionReader::nested_stage(const FieldInfo& info, std::string_view kind,
                                std::shared_ptr<const StageInterface>& stage) {
  const std::string name(info.name);
  known_.push_back(name);
  for (const Json* object : {static_cast<const Json*>(&base_), &given_})
    if (object->contains(name))
      stage = read_stage(registry_, kind, object->at(name), path_of(info), *stage);
}

void OptionReader::check_all_known(const std::string& owner) const {
  for (const auto& [key, value] : given_.items()) {
    if (key == "type" || std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    throw ConfigError(path_ + "." + key, owner + " has no option '" + key + "'",
                      known_.empty() ? "it has no options" : suggestion(key, known_));
  }
}

namespace {

const RegistryEntry& find_entry(const Registry& registry, std::string_view kind,
                                const std::string& name, const std::string& path) {
  try {
    return registry.find(kind, name);
  } catch (const ConfigError& error) {
    throw ConfigError(path, error.problem(), error.remedy());
  }
}

/// The name a stage is asked for by; nothing when only options are given.
std::optional<std::string> asked_name(const Json& given, const std::string& path) {
  if (given.is_string()) return given.get<std::string>();
  if (!given.is_object())
    throw ConfigError(path, json_line(given) + " is not a stage",
                      "give its name or an object such as {\"type\": NAME, OPTION: VALUE}");
  const auto type = given.find("type");
  if (type == given.end()) return std::nullopt;
  if (!type->is_string())
    throw ConfigError(path + ".type", json_line(*type) + " is not a name", "give a text");
  return type->get<std::string>();
}

}  // namespace

std::shared_ptr<const StageInterface> read_stage(const Registry& registry,
                                                 std::string_view kind, const Json& given,
                                                 const std::string& path,
                                                 const StageInterface& present) {
  const std::string present_name(present.info().name);
  const std::string name = asked_name(given, path).value_or(present_name);
  const RegistryEntry& entry = find_entry(registry, kind, name, path);
  const std::string owner = std::string(kind) + " '" + name + "'";
  if (!entry.unavailable.empty())
    throw ConfigError(path, owner + " is unavailable: " + entry.unavailable,
                      "choose another; `lacuna list " + std::string(kind) + "` shows them");
  Json base = name == present_name ? sorted_json(format_stage(present)) : Json::object();
  const Json options = given.is_object() ? given : Json::object();
  OptionReader reader(registry, std::move(base), options, path);
  auto stage = entry.make(reader);
  reader.check_all_known(owner);
  return stage;
}

}  // namespace lacuna
