// SPDX-License-Identifier: MIT
#include "lacuna/config/configuration.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "lacuna/core/text.hpp"
#include "lacuna/pipeline/presets.hpp"
#include "option_reader.hpp"

namespace lacuna {

struct Configuration::Document {
  Json root = Json::object();
};

namespace {

/// Stages of a pipeline.
const std::vector<std::string> kStageKeys = {
    "basis", "formulation", "differentiator", "filter", "regressor", "pruner", "refiner"};

/// Whatever may be given by its name alone.
bool is_stage_key(const std::string& key) {
  return key == "criterion" ||
         std::find(kStageKeys.begin(), kStageKeys.end(), key) != kStageKeys.end();
}

/// "line 3, column 7" of a byte position (from 1) in a text.
std::string position_text(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte > 0 ? byte - 1 : 0);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.rfind('\n');
  const std::size_t column =
      before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1;
  return std::to_string(line) + ":" + std::to_string(column);
}

Json parse_document(std::string_view text, const std::string& source) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw ConfigError(source + ":" + position_text(text, error.byte), "this is not JSON",
                      "check quotes, commas and brackets up to this place");
  }
}

/// Whether both name a type and not the same.
bool types_differ(const Json& a, const Json& b) {
  return a.contains("type") && b.contains("type") && a.at("type") != b.at("type");
}

/// `given` on top of `target`: objects are merged, everything else is replaced. A stage that is
/// given with another type replaces the one before, its options with it.
void merge_into(Json& target, const Json& given) {
  if (!target.is_object() || !given.is_object() || types_differ(target, given)) {
    target = given;
    return;
  }
  for (const auto& [key, value] : given.items()) {
    if (target.contains(key))
      merge_into(target[key], value);
    else
      target[key] = value;
  }
}

/// {"a": {"b": value}} from "a.b".
Json nested_value(std::string_view path, Json value) {
  const std::size_t dot = path.rfind('.');
  const std::string key(trim(path.substr(dot == std::string_view::npos ? 0 : dot + 1)));
  Json object;
  object[key] = std::move(value);
  if (dot == std::string_view::npos) return object;
  return nested_value(path.substr(0, dot), std::move(object));
}

/// The value of an assignment: JSON where it is some, else text.
Json value_of(std::string_view text) {
  Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() ? Json(std::string(text)) : value;
}

/// A stage given by its name alone becomes the object with that type.
Json with_stage_objects(Json root) {
  for (auto& [key, value] : root.items())
    if (is_stage_key(key) && value.is_string()) value = Json{{"type", value}};
  return root;
}

void check_keys(const Json& root) {
  std::vector<std::string> known = {"preset", "tolerances"};
  known.insert(known.end(), kStageKeys.begin(), kStageKeys.end());
  for (const auto& [key, value] : root.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw ConfigError("$." + key, "a configuration has no key '" + key + "'",
                        suggestion(key, known));
}

std::string text_at(const Json& root, const std::string& key, const std::string& otherwise) {
  if (!root.contains(key)) return otherwise;
  if (!root[key].is_string())
    throw ConfigError("$." + key, root[key].dump() + " is not a text", "give a text");
  return root[key].get<std::string>();
}

Tolerances read_tolerances(const Json& root) {
  const std::string name = text_at(root, "tolerances", "repaired");
  if (name == "repaired") return Tolerances::Repaired;
  if (name == "paper") return Tolerances::Paper;
  throw ConfigError("$.tolerances", "there are no tolerances '" + name + "'",
                    suggestion(name, std::vector<std::string>{"repaired", "paper"}));
}

Pipeline start_pipeline(const Json& root) {
  const std::string name = text_at(root, "preset", "algorithm1");
  try {
    return preset(name, read_tolerances(root));
  } catch (const ConfigError& error) {
    const bool placed = error.where().rfind("$", 0) == 0;
    throw ConfigError(placed ? error.where() : "$.preset", error.problem(), error.remedy());
  }
}

template <class Interface>
void override_stage(Stage<Interface>& stage, const Registry& registry, const Json& root,
                    const std::string& key) {
  if (!root.contains(key)) return;
  auto made = read_stage(registry, Interface::kKind, root.at(key), "$." + key, *stage);
  stage = Stage<Interface>(std::dynamic_pointer_cast<const Interface>(made));
}

/// Moves the short form `differentiator` to where it belongs.
Json with_differentiator_inside(Json root) {
  if (!root.contains("differentiator")) return root;
  merge_into(root, Json{{"formulation", {{"differentiator", root["differentiator"]}}}});
  root.erase("differentiator");
  return root;
}

}  // namespace

Configuration::Configuration() : document_(std::make_unique<Document>()) {}
Configuration::Configuration(const Configuration& other)
    : document_(std::make_unique<Document>(*other.document_)) {}
Configuration& Configuration::operator=(const Configuration& other) {
  *document_ = *other.document_;
  return *this;
}
Configuration::~Configuration() = default;

void Configuration::merge_text(std::string_view json, const std::string& source) {
  const Json given = parse_document(json, source);
  if (!given.is_object())
    throw ConfigError(source + ": $", "a configuration is a JSON object",
                      "write {\"preset\": ..., \"regressor\": {...}}");
  merge_into(document_->root, with_stage_objects(given));
}

void Configuration::merge_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path, "cannot be opened", "check the path of the configuration");
  std::ostringstream text;
  text << file.rdbuf();
  merge_text(text.str(), path);
}

void Configuration::set(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  const std::string_view path = trim(assignment.substr(0, equals));
  if (equals == std::string_view::npos || path.empty())
    throw ConfigError("--set " + std::string(assignment), "this is not PATH=VALUE",
                      "write e.g. --set regressor.threshold=0.05");
  const Json value = value_of(trim(assignment.substr(equals + 1)));
  merge_text(nested_value(path, value).dump(), "--set " + std::string(assignment));
}

void Configuration::set_preset(const std::string& name) { document_->root["preset"] = name; }

void Configuration::set_degree(int degree) {
  merge_text(Json{{"basis", {{"type", "monomials"}, {"max_degree", degree}}}}.dump(),
             "--degree");
}

void Configuration::set_terms(std::string_view list) {
  document_->root["basis"] = Json{{"type", "expressions"}, {"terms", split_list(list)}};
}

std::string Configuration::text() const { return document_->root.dump(); }

Pipeline Configuration::build(const Registry& registry) const {
  check_keys(document_->root);
  const Json root = with_differentiator_inside(document_->root);
  Pipeline pipeline = start_pipeline(root);
  override_stage(pipeline.basis, registry, root, "basis");
  override_stage(pipeline.formulation, registry, root, "formulation");
  override_stage(pipeline.filter, registry, root, "filter");
  override_stage(pipeline.regressor, registry, root, "regressor");
  override_stage(pipeline.pruner, registry, root, "pruner");
  override_stage(pipeline.refiner, registry, root, "refiner");
  return pipeline;
}

}  // namespace lacuna
