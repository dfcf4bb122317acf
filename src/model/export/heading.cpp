// SPDX-License-Identifier: MIT
#include "model/export/heading.hpp"

#include <algorithm>

#include "core/base/text.hpp"
#include "model/export/quoted_text.hpp"

namespace lacuna {
namespace {

/// " [rad]", or nothing.
std::string unit_text(const std::string& unit) {
  return unit.empty() ? "" : " [" + quoted_text(unit) + "]";
}

std::string names_with_units(const std::vector<Quantity>& quantities,
                             const ForeignNames& names) {
  std::vector<std::string> texts;
  for (const Quantity& quantity : quantities)
    texts.push_back(names.at(quantity.name) + unit_text(quantity.unit));
  return texts.empty() ? "none" : join(texts, ", ");
}

std::string outputs_lines(std::string_view sign, const OdeModel& model,
                          const ForeignNames& names) {
  if (model.outputs().empty()) return "";
  std::vector<std::string> texts;
  for (const Output& output : model.outputs())
    texts.push_back(names.at(output.name) + unit_text(output.unit));
  return comment_lines(sign, "Outputs: " + join(texts, ", ") + ".");
}

std::string parameters_lines(std::string_view sign, const SystemModel& model,
                             const ForeignNames& names) {
  std::vector<std::string> texts;
  for (const Parameter& parameter : model.parameters())
    texts.push_back(names.at(parameter.name) + unit_text(parameter.unit));
  return texts.empty() ? "" : comment_lines(sign, "Parameters: " + join(texts, ", ") + ".");
}

}  // namespace

std::set<std::string> names_in_rates(const OdeModel& model) {
  std::set<std::string> names;
  for (const Equation& equation : model.equations())
    for (const WeightedTerm& summand : equation)
      names.merge(summand.term.expression().variables());
  return names;
}

std::set<std::string> names_in_outputs(const OdeModel& model) {
  std::set<std::string> names;
  for (const Output& output : model.outputs()) names.merge(output.formula.variables());
  return names;
}

bool knows_start(const OdeModel& model) {
  return std::any_of(model.initial().begin(), model.initial().end(),
                     [](const auto& initial) { return initial.has_value(); });
}

ForeignNames foreign_names(const OdeModel& model, const NameRules& rules) {
  std::vector<std::string> names = names_of(model.states());
  for (const Quantity& input : model.inputs()) names.push_back(input.name);
  for (const Output& output : model.outputs()) names.push_back(output.name);
  return foreign_names(names, rules);
}

std::string renamed_lines(std::string_view sign, const OdeModel& model,
                          const ForeignNames& names) {
  std::vector<std::string> texts;
  for (const auto* quantities : {&model.states(), &model.inputs()})
    for (const Quantity& quantity : *quantities)
      if (const std::string& name = names.at(quantity.name); name != quantity.name)
        texts.push_back(quoted_text(quantity.name) + " is " + name);
  for (const Output& output : model.outputs())
    if (const std::string& name = names.at(output.name);
        name != output.name && !state_of(model, output))
      texts.push_back(quoted_text(output.name) + " is " + name);
  if (texts.empty()) return "";
  return comment_lines(sign, "Names that are others here: " + join(texts, ", ") + ".");
}

std::string heading(std::string_view sign, const SystemModel& system, const ForeignNames& names) {
  const OdeModel& model = system.symbolic();
  return comment_lines(sign, "Rates of a system of ordinary differential equations; time t" +
                                 unit_text(model.time_unit()) + ".") +
         comment_lines(sign, "States: " + names_with_units(model.states(), names) + ".") +
         comment_lines(sign, "Inputs: " + names_with_units(system.inputs(), names) + ".") +
         parameters_lines(sign, system, names) + outputs_lines(sign, model, names) +
         renamed_lines(sign, model, names);
}

std::string used_helpers(const std::string& text,
                         const std::vector<std::pair<std::string, std::string>>& helpers) {
  std::string used;
  for (const auto& [name, definition] : helpers)
    if (text.find(name + "(") != std::string::npos) used += definition;
  return used;
}

}  // namespace lacuna
