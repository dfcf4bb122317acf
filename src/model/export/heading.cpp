// SPDX-License-Identifier: MIT
#include "model/export/heading.hpp"

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

std::string outputs_lines(std::string_view sign, const OdeModel& model) {
  if (model.outputs().empty()) return "";
  std::vector<std::string> texts;
  for (const Output& output : model.outputs())
    texts.push_back(quoted_text(output.name) + unit_text(output.unit));
  return comment_lines(sign, "Left out: the outputs " + join(texts, ", ") + ".");
}

}  // namespace

ForeignNames foreign_names(const OdeModel& model, const NameRules& rules) {
  std::vector<std::string> names = names_of(model.states());
  for (const Quantity& input : model.inputs()) names.push_back(input.name);
  return foreign_names(names, rules);
}

std::string renamed_lines(std::string_view sign, const OdeModel& model,
                          const ForeignNames& names) {
  std::vector<std::string> texts;
  for (const auto* quantities : {&model.states(), &model.inputs()})
    for (const Quantity& quantity : *quantities)
      if (const std::string& name = names.at(quantity.name); name != quantity.name)
        texts.push_back(quoted_text(quantity.name) + " is " + name);
  if (texts.empty()) return "";
  return comment_lines(sign, "Names that are others here: " + join(texts, ", ") + ".");
}

std::string heading(std::string_view sign, const OdeModel& model, const ForeignNames& names) {
  return comment_lines(sign, "Rates of a system of ordinary differential equations; time t" +
                                 unit_text(model.time_unit()) + ".") +
         comment_lines(sign, "States: " + names_with_units(model.states(), names) + ".") +
         comment_lines(sign, "Inputs: " + names_with_units(model.inputs(), names) + ".") +
         renamed_lines(sign, model, names) + outputs_lines(sign, model);
}

std::string used_helpers(const std::string& text,
                         const std::vector<std::pair<std::string, std::string>>& helpers) {
  std::string used;
  for (const auto& [name, definition] : helpers)
    if (text.find(name + "(") != std::string::npos) used += definition;
  return used;
}

}  // namespace lacuna
