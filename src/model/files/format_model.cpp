// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/json.hpp"
#include "core/base/text.hpp"
#include "core/statistics/determined.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna {
namespace {

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
    elements.push_back(json_line(object));
  }
  return list_text(elements, "  ");
}

/// What is known of a coefficient or a parameter. An error or interval that is not finite says
/// nothing, and JSON has no way to write it; nor does an interval of what is not determined.
template <class Number>
void add_errors(double value, const Number& number, OrderedJson& object) {
  if (number.standard_error && std::isfinite(*number.standard_error))
    object["stderr"] = *number.standard_error;
  if (!number.ci95) return;
  const auto [low, high] = *number.ci95;
  if (std::isfinite(low) && std::isfinite(high) && is_determined(value, high / 2.0 - low / 2.0))
    object["ci95"] = *number.ci95;
}

std::string summand_text(const WeightedTerm& summand) {
  OrderedJson object{{"term", summand.term.name()}, {"coefficient", summand.coefficient}};
  if (summand.fixed) object["fixed"] = true;
  add_errors(summand.coefficient, summand, object);
  return json_line(object);
}

std::string parameter_text(const Parameter& parameter) {
  OrderedJson object{{"name", parameter.name}, {"value", parameter.value}};
  object["unit"] = parameter.unit;
  object["free"] = parameter.free;
  if (parameter.min) object["min"] = *parameter.min;
  if (parameter.max) object["max"] = *parameter.max;
  if (parameter.per_record) object["per_record"] = true;
  if (parameter.deviation) object["deviation"] = *parameter.deviation;
  if (parameter.factor) object["factor"] = *parameter.factor;
  if (const auto& spread = parameter.varies)
    object["varies"] = {{spread->by_factor ? "factor" : "deviation", spread->size}};
  add_errors(parameter.value, parameter, object);
  return json_line(object);
}

OrderedJson noise_json(const NoiseLaw& law) {
  OrderedJson object{{"law", to_string(law.form)}};
  if (law.form == NoiseForm::Student) object["freedom"] = law.freedom;
  if (law.constant) object["constant"] = *law.constant;
  if (law.fraction) object["fraction"] = *law.fraction;
  if (law.below) object["below"] = *law.below;
  if (law.above) object["above"] = *law.above;
  if (law.truncated) object["truncated"] = true;
  return object;
}

std::string output_text(const Output& output) {
  OrderedJson object{{"name", output.name},
                     {"expression", output.formula.to_string()},
                     {"unit", output.unit}};
  if (output.noise) object["noise"] = noise_json(*output.noise);
  return json_line(object);
}

std::string event_json(const Event& event) {
  OrderedJson object = OrderedJson::object(), set = OrderedJson::object();
  if (event.guard) {
    object["when"] = occasion_text(event).substr(std::string("when ").size());
  } else if (event.period) {
    object["every"] = *event.period;
    object["from"] = *event.time;
    if (event.last) object["until"] = *event.last;
  } else {
    object["at"] = *event.time;
  }
  for (const Reset& reset : event.resets) set[reset.state] = reset.value.to_string();
  object["set"] = std::move(set);
  return json_line(object);
}

std::string initial_text(const InitialValue& initial) {
  OrderedJson object{{"value", initial.value}};
  if (initial.fixed) object["fixed"] = true;
  if (initial.deviation) object["deviation"] = *initial.deviation;
  if (initial.time) object["at"] = *initial.time;
  return json_line(object);
}

/// The sections that not every model has.
std::string further_sections(const SystemModel& system) {
  const OdeModel& model = system.symbolic();
  std::string text;
  std::vector<std::string> parameters, outputs, initial;
  for (const Parameter& parameter : system.parameters())
    parameters.push_back(parameter_text(parameter));
  for (const Output& output : model.outputs()) outputs.push_back(output_text(output));
  for (std::size_t k = 0; k < model.states().size(); ++k)
    if (const auto& value = model.initial()[k])
      initial.push_back(json_line(OrderedJson(model.states()[k].name)) + ": " +
                        initial_text(*value));
  if (!parameters.empty())
    text.append(",\n \"parameters\": ").append(list_text(parameters, "  "));
  if (!outputs.empty()) text.append(",\n \"outputs\": ").append(list_text(outputs, "  "));
  if (!initial.empty())
    text.append(",\n \"initial\": {").append(join(initial, ", ")).append("}");
  std::vector<std::string> events;
  for (const Event& event : model.events()) events.push_back(event_json(event));
  if (!events.empty()) text.append(",\n \"events\": ").append(list_text(events, "  "));
  return text;
}

std::string equation_text(const std::string& state, const Equation& equation) {
  std::vector<std::string> elements;
  for (const WeightedTerm& summand : equation) elements.push_back(summand_text(summand));
  std::string text = "{\"state\": ";
  text.append(json_line(OrderedJson(state))).append(", \"terms\": ");
  return text.append(list_text(elements, "    ")).append("}");
}

}  // namespace

std::string format_model(const SystemModel& system) {
  const OdeModel& model = system.symbolic();
  std::vector<std::string> equations;
  for (std::size_t i = 0; i < model.equations().size(); ++i)
    equations.push_back(equation_text(model.states()[i].name, model.equations()[i]));
  std::string text = "{\"format\": \"lacuna.model/1\",\n \"time_unit\": ";
  text.append(json_line(OrderedJson(model.time_unit())));
  if (model.is_map()) text.append(",\n \"time\": \"discrete\"");
  text.append(",\n \"states\": ").append(quantities_text(model.states()));
  text.append(",\n \"inputs\": ").append(quantities_text(system.inputs()));
  text.append(",\n \"equations\": ").append(list_text(equations, "  "));
  return text.append(further_sections(system)).append("}\n");
}

}  // namespace lacuna
