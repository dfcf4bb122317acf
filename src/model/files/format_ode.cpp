// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include "core/base/text.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "model/equations/linear_terms.hpp"

namespace lacuna {
namespace {

std::string with_unit(const std::string& name, const std::string& unit) {
  return name + (unit.empty() ? "" : " [" + unit + "]");
}

std::string parameter_line(const Parameter& parameter) {
  std::string text = "param " + parameter.name + " = " + format_number(parameter.value);
  if (parameter.deviation) text += " +- " + format_number(*parameter.deviation);
  if (parameter.factor) text += " */ " + format_number(*parameter.factor);
  if (parameter.varies)
    text += (parameter.varies->by_factor ? " varies */ " : " varies +- ") +
            format_number(parameter.varies->size);
  text = with_unit(text, parameter.unit);
  if (parameter.min || parameter.max)
    text += " in " + (parameter.min ? format_number(*parameter.min) : "") + ".." +
            (parameter.max ? format_number(*parameter.max) : "");
  if (!parameter.free) text += " fixed";
  if (parameter.per_record) text += " per_record";
  return text + "\n";
}

/// Lines for the terms of which their numbers do not say whether they are fixed.
std::string choices_text(const SystemModel& system) {
  bool any_free = false;
  for (const Parameter& parameter : system.parameters()) any_free = any_free || parameter.free;
  std::string text;
  for (std::size_t k = 0; k < system.symbolic().states().size(); ++k)
    for (const WeightedTerm& summand : system.symbolic().equations()[k]) {
      const bool read_so = any_free && std::abs(summand.coefficient) == 1.0 &&
                           !system.gives_size(summand.term.expression());
      if (summand.fixed != read_so && summand.coefficient != 0.0)
        text +=
            (summand.fixed ? "fixed " : "free ") +
            left_hand_side(system.symbolic().states()[k].name, system.symbolic().evolution()) +
            ": " + summand.term.name() + "\n";
    }
  return text;
}

/// The equations; a sum that is one term is to be read as one term again.
std::string equations_text(const OdeModel& model) {
  const VariableIndex variables(model.variables());
  std::vector<Equation> equations = model.equations();
  for (Equation& equation : equations)
    for (WeightedTerm& summand : equation)
      summand.term = Term(kept_together(summand.term.expression()), variables);
  return to_text(model.with_equations(std::move(equations))) + "\n";
}

std::string initial_text(const std::string& state, const InitialValue& initial) {
  return "initial " + state + " = " + format_number(initial.value) +
         (initial.time ? " at " + format_number(*initial.time) : "") +
         (initial.deviation ? " deviation " + format_number(*initial.deviation) : "") +
         (initial.fixed ? " fixed\n" : "\n");
}

std::string event_line(const Event& event) {
  std::vector<std::string> resets;
  for (const Reset& reset : event.resets) resets.push_back(to_text(reset));
  return occasion_text(event) + ": " + join(resets, ", ") + "\n";
}

/// A unit that would be a comment or an output stands in brackets.
std::string time_line(const std::string& unit) {
  if (unit.empty()) return "time\n";
  const bool plain = unit.front() != '=' && unit.find('#') == std::string::npos;
  return plain ? "time " + unit + "\n" : "time [" + unit + "]\n";
}

}  // namespace

std::string format_ode(const SystemModel& system) {
  const OdeModel& model = system.symbolic();
  std::string text = time_line(model.time_unit());
  for (const Quantity& input : system.inputs())
    text += "input " + with_unit(input.name, input.unit) +
            (input.hold ? " hold " + to_string(*input.hold) : "") + "\n";
  for (const Quantity& state : model.states())
    text += "state " + with_unit(state.name, state.unit) + "\n";
  for (const Parameter& parameter : system.parameters()) text += parameter_line(parameter);
  text += equations_text(model) + choices_text(system);
  for (const Output& output : model.outputs())
    text += output.name + " = " + with_unit(output.formula.to_string(), output.unit) +
            (output.noise ? " " + to_text(*output.noise) : "") + "\n";
  for (std::size_t k = 0; k < model.states().size(); ++k)
    if (const auto& initial = model.initial()[k])
      text += initial_text(model.states()[k].name, *initial);
  for (const Event& event : model.events()) text += event_line(event);
  return text;
}

}  // namespace lacuna
