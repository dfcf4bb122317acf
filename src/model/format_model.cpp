// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lacuna/model/model_file.hpp"

namespace lacuna {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string dump(const OrderedJson& value) {
  return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

/// A list with one element per line.
std::string list_text(const std::vector<std::string>& elements, const std::string& indent) {
  if (elements.empty()) return "[]";
  std::string text = "[";
  for (std::size_t i = 0; i < elements.size(); ++i)
    text.append(i == 0 ? "\n" : ",\n").append(indent).append(elements[i]);
  return text.append("]");
}

std::string quantities_text(const std::vector<Quantity>& quantities) {
  std::vector<std::string> elements;
  for (const Quantity& quantity : quantities) {
    OrderedJson object{{"name", quantity.name}, {"unit", quantity.unit}};
    if (quantity.hold) object["hold"] = to_string(*quantity.hold);
    elements.push_back(dump(object));
  }
  return list_text(elements, "  ");
}

/// An error or interval that is not finite says nothing, and JSON has no way to write it.
std::string summand_text(const WeightedTerm& summand) {
  OrderedJson object{{"term", summand.term.name()}, {"coefficient", summand.coefficient}};
  if (summand.standard_error && std::isfinite(*summand.standard_error))
    object["stderr"] = *summand.standard_error;
  if (summand.ci95 && std::isfinite((*summand.ci95)[0]) && std::isfinite((*summand.ci95)[1]))
    object["ci95"] = *summand.ci95;
  return dump(object);
}

std::string equation_text(const std::string& state, const Equation& equation) {
  std::vector<std::string> elements;
  for (const WeightedTerm& summand : equation) elements.push_back(summand_text(summand));
  std::string text = "{\"state\": ";
  text.append(dump(state)).append(", \"terms\": ");
  return text.append(list_text(elements, "    ")).append("}");
}

}  // namespace

std::string format_model(const OdeModel& model) {
  std::vector<std::string> equations;
  for (std::size_t i = 0; i < model.equations().size(); ++i)
    equations.push_back(equation_text(model.states()[i].name, model.equations()[i]));
  std::string text = "{\"format\": \"lacuna.model/1\",\n \"time_unit\": ";
  text.append(dump(model.time_unit()));
  text.append(",\n \"states\": ").append(quantities_text(model.states()));
  text.append(",\n \"inputs\": ").append(quantities_text(model.inputs()));
  text.append(",\n \"equations\": ").append(list_text(equations, "  "));
  return text.append("}\n");
}

}  // namespace lacuna
