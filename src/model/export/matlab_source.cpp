// SPDX-License-Identifier: MIT
#include "model/export/dialect.hpp"
#include "model/export/heading.hpp"
#include "model/export/languages.hpp"
#include "model/export/sources.hpp"

namespace lacuna {
namespace {

/// Where MATLAB goes on with complex numbers, or leaves nan out, these give nan.
const std::vector<std::pair<std::string, std::string>>& matlab_helpers() {
  static const std::vector<std::pair<std::string, std::string>> helpers = {
      {"lacuna_real",
       "\nfunction v = lacuna_real(v)\n  if imag(v) ~= 0\n    v = NaN;\n  end\nend\n"},
      {"lacuna_step",
       "\nfunction v = lacuna_step(v)\n  if v >= 0\n    v = 1;\n  elseif v < 0\n    v = 0;\n"
       "  end\nend\n"},
      {"lacuna_min",
       "\nfunction v = lacuna_min(v, w)\n  if ~(v < w || v ~= v)\n    v = w;\n  end\nend\n"},
      {"lacuna_max",
       "\nfunction v = lacuna_max(v, w)\n  if ~(v > w || v ~= v)\n    v = w;\n  end\nend\n"}};
  return helpers;
}

Dialect matlab_dialect(const OdeModel& model) {
  Dialect matlab{
      .name = "MATLAB", .names = foreign_names(model, matlab_names()), .real = "lacuna_real"};
  for (const auto& [operation, function] : {std::pair{Operation::Sqrt, "sqrt"},
                                            {Operation::Log, "log"},
                                            {Operation::Asin, "asin"},
                                            {Operation::Acos, "acos"}})
    matlab.calls[operation] = [function =
                                   std::string(function)](const std::vector<std::string>& o) {
      return "lacuna_real(" + function + "(" + o[0] + "))";
    };
  matlab.calls[Operation::Step] = called("lacuna_step");
  matlab.calls[Operation::Min] = called("lacuna_min");
  matlab.calls[Operation::Max] = called("lacuna_max");
  matlab.calls[Operation::Clip] = [](const std::vector<std::string>& o) {
    return "lacuna_min(lacuna_max(" + o[0] + ", " + o[1] + "), " + o[2] + ")";
  };
  return matlab;
}

/// "  x = state(1);"
std::string taken_from(const std::string& vector, const std::vector<std::string>& names,
                       const Dialect& dialect) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += "  " + code_name(names[i], dialect) + " = " + vector + "(" + std::to_string(i + 1) +
            ");\n";
  return text;
}

/// "  rate = [\n    (x)\n  ];\n"
std::string column(const std::string& name, const std::vector<std::string>& formulas) {
  if (formulas.empty()) return "  " + name + " = zeros(0, 1);\n";
  std::string text = "  " + name + " = [\n";
  for (const std::string& formula : formulas) text += "    (" + formula + ")\n";
  return text + "  ];\n";
}

std::string parameters_text(const SystemModel& system, const Dialect& dialect) {
  std::vector<std::string> names, values;
  for (const Parameter& parameter : system.parameters()) {
    names.push_back(parameter.name);
    values.push_back(format_number(parameter.value));
  }
  if (names.empty()) return "";
  return "  if nargin < 4\n    parameter = [" + join(values, "; ") + "];\n  end\n" +
         taken_from("parameter", names, dialect);
}

std::vector<std::string> starts(const OdeModel& model) {
  std::vector<std::string> texts;
  for (const auto& initial : model.initial())
    texts.push_back(format_number(initial ? initial->value : 0.0));
  return texts;
}

}  // namespace

std::string export_matlab(const SystemModel& system) {
  const OdeModel& model = system.symbolic();
  const Dialect matlab = matlab_dialect(model);
  std::vector<std::string> rates, outputs;
  for (const Equation& equation : model.equations()) rates.push_back(code(equation, matlab));
  for (const Output& output : model.outputs()) outputs.push_back(code(output.formula, matlab));
  const std::string parameter = system.parameters().empty() ? "" : ", parameter";
  const std::string body = column("rate", rates) + column("output", outputs);
  return "function [rate, output, initial] = lacuna_rate(t, state, input" + parameter + ")\n" +
         heading("% ", system, matlab.names) +
         "% Simulink: put this into a MATLAB Function block, rate into an Integrator that starts\n"
         "% at initial, and the output of the Integrator back into state.\n" +
         parameters_text(system, matlab) + taken_from("state", names_of(model.states()), matlab) +
         taken_from("input", names_of(system.inputs()), matlab) + body +
         column("initial", starts(model)) + "end\n" + used_helpers(body, matlab_helpers());
}

}  // namespace lacuna
