// SPDX-License-Identifier: MIT
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

/// "  Real x(unit="m");"
std::string declaration(const Quantity& quantity, const std::string& kind,
                        const Dialect& dialect) {
  const std::string unit =
      quantity.unit.empty() ? "" : "(unit=\"" + quoted_text(quantity.unit) + "\")";
  return "  " + kind + "Real " + code_name(quantity.name, dialect) + unit + ";\n";
}

}  // namespace

std::string export_modelica(const OdeModel& model) {
  const Dialect modelica = modelica_dialect(model);
  std::string text = heading("// ", model, modelica.names) + "model LacunaModel\n";
  for (const Quantity& input : model.inputs()) text += declaration(input, "input ", modelica);
  for (const Quantity& state : model.states()) text += declaration(state, "", modelica);
  text += "equation\n";
  for (std::size_t k = 0; k < model.states().size(); ++k)
    text += "  der(" + code_name(model.states()[k].name, modelica) +
            ") = " + code(model.equations()[k], modelica) + ";\n";
  return text + "end LacunaModel;\n";
}

}  // namespace lacuna
