// SPDX-License-Identifier: MIT
#include <cmath>
#include <set>
#include <string>

#include "core/base/text.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "model/equations/linear_terms.hpp"
#include "summand_text.hpp"

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

/// How the terms of a system are written, so that reading gives them back.
struct Writing {
  const SystemModel& system;
  std::set<std::string> parameters;
  bool any_free = false;  ///< then a term without a number in front of it is fixed

  explicit Writing(const SystemModel& model) : system(model) {
    for (const Parameter& parameter : model.parameters()) {
      parameters.insert(parameter.name);
      any_free = any_free || parameter.free;
    }
  }

  /// Whether a number says that a coefficient is free.
  bool needs_number(const WeightedTerm& summand) const {
    return any_free && !summand.fixed && !system.gives_size(summand.term.expression());
  }

  /// A summand without its sign.
  std::string text_of(const WeightedTerm& summand) const {
    const double size = std::abs(summand.coefficient);
    const One one = needs_number(summand) ? One::Written : One::LeftOut;
    return summand_text(kept_together(summand.term.expression(), parameters,
                                      size == 1.0 && one == One::LeftOut),
                        format_number(size), one);
  }

  /// Whether a summand is read as fixed from its text.
  bool reads_fixed(const WeightedTerm& summand) const {
    if (!any_free || system.gives_size(summand.term.expression())) return false;
    const Equation read =
        linear_terms(parse_summands(text_of(summand)),
                     VariableIndex(system.symbolic().variables()), parameters);
    return read.size() == 1 && read.front().fixed;
  }
};

std::string equation_text(const Equation& equation, const Writing& writing) {
  std::string text;
  for (const WeightedTerm& summand : equation) {
    if (summand.coefficient == 0.0) continue;
    const bool negative = summand.coefficient < 0.0;
    text += text.empty() ? (negative ? "-" : "") : negative ? " - " : " + ";
    text += writing.text_of(summand);
  }
  return text.empty() ? "0" : text;
}

/// The equations, and lines for the terms that their text does not say are fixed.
std::string equations_text(const SystemModel& system) {
  const OdeModel& model = system.symbolic();
  const Writing writing(system);
  std::string equations, choices;
  for (std::size_t k = 0; k < model.states().size(); ++k) {
    const std::string left = left_hand_side(model.states()[k].name, model.evolution());
    equations += left + " = " + equation_text(model.equations()[k], writing) + "\n";
    for (const WeightedTerm& summand : model.equations()[k])
      if (summand.fixed && summand.coefficient != 0.0 && !writing.reads_fixed(summand))
        choices += "fixed " + left + ": " + summand.term.name() + "\n";
  }
  return equations + choices;
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
  text += equations_text(system);
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
