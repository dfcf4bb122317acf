// SPDX-License-Identifier: MIT
#include <optional>

#include "core/base/text.hpp"
#include "model/export/dialect.hpp"
#include "model/export/heading.hpp"
#include "model/export/languages.hpp"
#include "model/export/quoted_text.hpp"
#include "model/export/sources.hpp"

namespace lacuna {
namespace {

Dialect modelica_dialect(const OdeModel& model) {
  Dialect modelica{.name = "Modelica",
                   .names = foreign_names(model, modelica_names()),
                   .number = number_with_point,
                   .time = "time",
                   .has_delay = true};
  modelica.calls[Operation::Step] = [](const std::vector<std::string>& o) {
    return "(if " + o[0] + " >= 0.0 then 1.0 else 0.0)";
  };
  modelica.calls[Operation::Clip] = [](const std::vector<std::string>& o) {
    return "min(max(" + o[0] + ", " + o[1] + "), " + o[2] + ")";
  };
  return modelica;
}

/// "  Real x(unit="m", start=1.0, fixed=true);"
std::string declaration(const std::string& name, const std::string& unit, const std::string& kind,
                        const std::optional<InitialValue>& start, const Dialect& dialect) {
  std::vector<std::string> attributes;
  if (!unit.empty()) attributes.push_back("unit=\"" + quoted_text(unit) + "\"");
  if (start)
    attributes.push_back("start=" + number_with_point(start->value) + ", fixed=true");
  return "  " + kind + "Real " + code_name(name, dialect) +
         (attributes.empty() ? "" : "(" + join(attributes, ", ") + ")");
}

std::string declarations(const SystemModel& system, const Dialect& dialect) {
  const OdeModel& model = system.symbolic();
  std::string text;
  for (const Parameter& parameter : system.parameters())
    text += declaration(parameter.name, parameter.unit, "parameter ", {}, dialect) + " = " +
            number_with_point(parameter.value) + ";\n";
  for (const Quantity& input : system.inputs())
    text += declaration(input.name, input.unit, "input ", {}, dialect) + ";\n";
  for (std::size_t k = 0; k < model.states().size(); ++k)
    text += declaration(model.states()[k].name, model.states()[k].unit, "", model.initial()[k],
                        dialect) +
            ";\n";
  for (const Output& output : model.outputs())
    if (!state_of(model, output))
      text += declaration(output.name, output.unit, "output ", {}, dialect) + ";\n";
  return text;
}

}  // namespace

std::string export_modelica(const SystemModel& system) {
  const OdeModel& model = system.symbolic();
  const Dialect modelica = modelica_dialect(model);
  std::string text = heading("// ", system, modelica.names) + "model LacunaModel\n" +
                     declarations(system, modelica) + "equation\n";
  for (std::size_t k = 0; k < model.states().size(); ++k)
    text += "  der(" + code_name(model.states()[k].name, modelica) +
            ") = " + code(model.equations()[k], modelica) + ";\n";
  for (const Output& output : model.outputs())
    if (!state_of(model, output))
      text += "  " + code_name(output.name, modelica) + " = " + code(output.formula, modelica) +
              ";\n";
  return text + "end LacunaModel;\n";
}

}  // namespace lacuna
