// SPDX-License-Identifier: MIT
#include "lacuna/cli/configuration/configuration.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/json.hpp"
#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "core/files/file_bytes.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "model/files/strict_json.hpp"
#include "option_reader.hpp"

namespace lacuna {

struct Configuration::Document {
  Json root = Json::object();
  std::map<std::string, std::string> said;  ///< by set() and its like: what, and how
  Json options = Json::object();  ///< what options of a command line give, in the root

  /// @throws ConfigError that names both when it has been said before.
  void say(const std::string& what, const std::string& option, const std::string& text) {
    const auto [first, is_new] = said.emplace(what, text);
    if (is_new) return;
    throw ConfigError(option + " " + text,
                      what + " is given twice, first as '" + first->second + "'", "keep one");
  }

  void merge_option(const Json& given, const std::string& text);
};

namespace {

/// Stages of a pipeline.
const std::vector<std::string> kStageKeys = {
    "basis", "formulation", "differentiator", "filter", "regressor", "pruner", "refiner"};

/// What `identify` does besides a pipeline: options that change no stage.
const std::vector<std::string> kRuleKeys = {"library",         "forms",      "dead-time",
                                            "plain-structure", "validation", "relations",
                                            "advice",          "map",        "sync"};

bool is_in(const std::vector<std::string>& list, const std::string& key) {
  return std::find(list.begin(), list.end(), key) != list.end();
}

/// Whatever may be given by its name alone.
bool is_stage_key(const std::string& key) {
  return key == "criterion" || is_in(kStageKeys, key);
}

Json parse_document(std::string_view text, const std::string& source) {
  try {
    return parse_strict_json(text, source);
  } catch (const ModelError& error) {
    throw ConfigError(error.where(), error.problem(), error.remedy());
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

/// The path of the first value that both give, and not the same: "basis.max_degree".
std::optional<std::string> disagreement(const Json& before, const Json& given,
                                        const std::string& path = "") {
  if (!before.is_object() || !given.is_object())
    return before == given ? std::nullopt : std::optional(path);
  for (const auto& [key, value] : given.items()) {
    if (!before.contains(key)) continue;
    auto found = disagreement(before.at(key), value, path + (path.empty() ? "" : ".") + key);
    if (found) return found;
  }
  return std::nullopt;
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
Json value_of(std::string_view text, const std::string& source) {
  if (!is_json(text)) return std::string(text);
  return parse_document(text, source);
}

/// A stage given by its name alone becomes the object with that type.
Json with_stage_objects(Json root) {
  for (auto& [key, value] : root.items())
    if (is_stage_key(key) && value.is_string()) value = Json{{"type", value}};
  return root;
}

void check_keys(const Json& root) {
  std::vector<std::string> known = {"preset", "tolerances", "equations", "constraints"};
  known.insert(known.end(), kStageKeys.begin(), kStageKeys.end());
  known.insert(known.end(), kRuleKeys.begin(), kRuleKeys.end());
  for (const auto& [key, value] : root.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw ConfigError("$." + key, "a configuration has no key '" + key + "'",
                        suggestion(key, known));
}

std::string text_at(const Json& root, const std::string& key, const std::string& otherwise) {
  if (!root.contains(key)) return otherwise;
  if (!root[key].is_string())
    throw ConfigError("$." + key, json_line(root[key]) + " is not a text", "give a text");
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

/// Libraries of equations: {"w": ["sin(th)", "w"]}.
std::vector<EquationTerms> read_equations(const Json& root) {
  std::vector<EquationTerms> equations;
  if (!root.contains("equations")) return equations;
  if (!root["equations"].is_object())
    throw ConfigError("$.equations", "this is no object",
                      R"x(write {"w": ["sin(th)", "w", "u"]})x");
  for (const auto& [state, terms] : root["equations"].items()) {
    if (!terms.is_array() || !std::all_of(terms.begin(), terms.end(),
                                          [](const Json& term) { return term.is_string(); }))
      throw ConfigError("$.equations." + state, "this is no list of formulas",
                        R"x(write ["sin(th)", "w", "u"])x");
    equations.push_back({state, terms.get<std::vector<std::string>>()});
  }
  return equations;
}

/// "-2 y: x*z": a factor, where there is one, an equation and a term.
NamedCoefficient read_summand(const std::string& text, const std::string& where) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
    throw ConfigError(where, "'" + text + "' is not STATE: TERM",
                      "write e.g. --constraint \"y: x*z, z: x*y = 0\"");
  std::string state(trim(std::string_view(text).substr(0, colon)));
  double factor = 1.0;
  if (const std::size_t blank = state.find(' '); blank != std::string::npos) {
    const auto number = parse_number(state.substr(0, blank));
    if (!number || !std::isfinite(*number))
      throw ConfigError(where, "'" + state.substr(0, blank) + "' is no number",
                        "write the factor in front of the state: \"-2 y: x*z\"");
    factor = *number;
    state = trim(std::string_view(state).substr(blank));
  }
  return {state, std::string(trim(std::string_view(text).substr(colon + 1))), factor};
}

/// "<" and "<=" are one: what is bounded may be at its bound.
ConstraintRelation relation_of(char sign) {
  if (sign == '<') return ConstraintRelation::AtMost;
  return sign == '>' ? ConstraintRelation::AtLeast : ConstraintRelation::Equal;
}

EquationConstraint read_constraint(const std::string& text, const std::string& where) {
  const std::size_t sign = text.find_last_of("<>=");
  if (sign == std::string::npos)
    throw ConfigError(where, "'" + text + "' has no =, < or >",
                      "write e.g. --constraint \"y: x*z, z: x*y = 0\" or \"y: x < 0\"");
  const auto value = parse_number(std::string(trim(std::string_view(text).substr(sign + 1))));
  if (!value || !std::isfinite(*value))
    throw ConfigError(where, std::string("what stands behind ") + text[sign] + " is no number",
                      "write e.g. \"w: u = 1\"");
  const bool has_two =
      text[sign] == '=' && sign > 0 && (text[sign - 1] == '<' || text[sign - 1] == '>');
  const std::size_t first = has_two ? sign - 1 : sign;
  EquationConstraint constraint{{}, *value, relation_of(text[first])};
  for (const std::string& summand : split_list(std::string_view(text).substr(0, first)))
    constraint.summands.push_back(read_summand(summand, where));
  return constraint;
}

/// Constraints: ["y: x*z, z: x*y = 0", "energy-preserving"].
void read_constraints(const Json& root, Pipeline& pipeline) {
  if (!root.contains("constraints")) return;
  const Json& list = root["constraints"];
  if (!list.is_array())
    throw ConfigError("$.constraints", "this is no list", R"x(write ["y: x*z, z: x*y = 0"])x");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string where = "$.constraints[" + std::to_string(i) + "]";
    if (!list[i].is_string())
      throw ConfigError(where, "this is no text", R"x(write "y: x*z, z: x*y = 0")x");
    const auto text = list[i].get<std::string>();
    if (text == "energy-preserving")
      pipeline.energy_preserving = true;
    else
      pipeline.constraints.push_back(read_constraint(text, where));
  }
}

/// Moves the short form `differentiator` to where it belongs.
Json with_differentiator_inside(Json root) {
  if (!root.contains("differentiator")) return root;
  merge_into(root, Json{{"formulation", {{"differentiator", root["differentiator"]}}}});
  root.erase("differentiator");
  return root;
}

}  // namespace

/// What an option gives replaces what files say, nothing that another option gives.
/// @param text the option, for messages.
/// @throws ConfigError where another option says otherwise.
void Configuration::Document::merge_option(const Json& given, const std::string& text) {
  if (const auto path = disagreement(options, given))
    throw ConfigError(text, "another option gives '" + *path + "' too, and not the same",
                      "keep one");
  merge_into(options, given);
  merge_into(root, given);
}

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
  merge_text(read_text_file(path, "configuration"), path);
}

void Configuration::set(std::string_view assignment) {
  constexpr std::size_t kShown = 60;  // letters of an option that a message repeats
  const std::string source = "--set " + std::string(assignment.substr(0, kShown)) +
                             (assignment.size() > kShown ? "..." : "");
  if (!is_utf8(assignment))
    throw ConfigError(source, "this is not UTF-8", "write it in UTF-8 or plain letters");
  const std::size_t equals = assignment.find('=');
  const std::string_view path = trim(assignment.substr(0, equals));
  if (equals == std::string_view::npos || path.empty())
    throw ConfigError(source, "this is not PATH=VALUE",
                      "write e.g. --set regressor.threshold=0.05");
  if (static_cast<std::size_t>(std::count(path.begin(), path.end(), '.')) >= kDeepestJson)
    throw ConfigError(source, "nested deeper than " + std::to_string(kDeepestJson) + " levels",
                      "a configuration has a few: stage, option, value");
  document_->say("'" + std::string(path) + "'", "--set", std::string(assignment));
  const Json value = value_of(trim(assignment.substr(equals + 1)), source);
  document_->merge_option(with_stage_objects(nested_value(path, value)), source);
}

void Configuration::set_preset(const std::string& name) {
  document_->merge_option({{"preset", name}}, "--preset " + name);
}

void Configuration::set_discrete() {
  document_->root["formulation"] = Json::object();
  document_->merge_option({{"formulation", {{"type", "next-sample"}}}}, "--discrete");
  document_->root["refiner"] = Json{{"type", "none"}};
}

void Configuration::set_degree(int degree) {
  document_->merge_option({{"basis", {{"type", "monomials"}, {"max_degree", degree}}}},
                          "--degree " + std::to_string(degree));
}

void Configuration::set_terms(std::string_view list) {
  document_->root["basis"] = Json::object();
  document_->merge_option({{"basis", {{"type", "expressions"}, {"terms", split_list(list)}}}},
                          "--terms");
}

void Configuration::add_terms(std::string_view list) {
  document_->merge_option({{"basis", {{"include", split_list(list)}}}}, "--add");
}

void Configuration::set_by(const std::string& option, std::string_view path,
                           std::string_view json) {
  document_->merge_option(nested_value(path, parse_document(json, option)), option);
}

void Configuration::set_equation(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos)
    throw ConfigError("--equation " + std::string(text), "there is no colon",
                      "write e.g. --equation \"w: sin(th), w, u\"");
  const std::string state(trim(text.substr(0, colon)));
  document_->say("the equation of '" + state + "'", "--equation", std::string(text));
  document_->root["equations"][state] = split_list(text.substr(colon + 1));
}

void Configuration::add_constraint(const std::string& text) {
  std::string summands = text.substr(0, text.find_first_of("<>="));
  std::erase(summands, ' ');
  // A sum may be bounded on both sides.
  if (const std::size_t sign = text.find_first_of("<>"); sign != std::string::npos)
    summands += text[sign];
  document_->say("what " + summands + " is", "--fix", text);
  Json& constraints = document_->root["constraints"];
  if (!constraints.is_array()) constraints = Json::array();
  constraints.push_back(text);
}

std::string Configuration::text() const { return json_line(document_->root); }

bool Configuration::says_pipeline() const {
  const Json& root = document_->root;
  return std::any_of(root.items().begin(), root.items().end(),
                     [](const auto& item) { return !is_in(kRuleKeys, item.key()); });
}

bool Configuration::says(std::string_view key) const {
  return document_->root.contains(std::string(key));
}

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
  pipeline.equations = read_equations(root);
  read_constraints(root, pipeline);
  return pipeline;
}

}  // namespace lacuna
