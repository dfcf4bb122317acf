// SPDX-License-Identifier: MIT
#include "model/export/dialect.hpp"
#include "model/export/heading.hpp"
#include "model/export/languages.hpp"
#include "model/export/sources.hpp"
#include "model/expressions/operations.hpp"

namespace lacuna {
namespace {

/// Variables are NumPy's numbers, so that what is undefined is nan, not an exception or
/// complex.
Dialect python_dialect(const OdeModel& model) {
  Dialect python{.name = "Python",
                 .names = foreign_names(model, python_names()),
                 .number = number_with_point,
                 .power_sign = "**",
                 .scalar = "np.float64"};
  for (const std::string& function : function_names())
    python.calls[*function_named(function)] = called("np." + function);
  for (const auto& [operation, function] : {std::pair{Operation::Asin, "np.arcsin"},
                                            {Operation::Acos, "np.arccos"},
                                            {Operation::Atan, "np.arctan"},
                                            {Operation::Min, "np.minimum"},
                                            {Operation::Max, "np.maximum"}})
    python.calls[operation] = called(function);
  python.calls[Operation::Step] = [](const std::vector<std::string>& o) {
    return "np.heaviside(" + o[0] + ", 1.0)";
  };
  python.calls[Operation::Clip] = [](const std::vector<std::string>& o) {
    return "np.minimum(np.maximum(" + o[0] + ", " + o[1] + "), " + o[2] + ")";
  };
  return python;
}

/// "    x, y, = np.asarray(state, dtype=float)"
std::string unpacked(const std::vector<std::string>& quantities, const std::string& from,
                     const Dialect& dialect) {
  std::string names;
  for (const std::string& one : quantities) names += code_name(one, dialect) + ", ";
  if (names.empty()) return "";
  names.pop_back();
  return "    " + names + " = np.asarray(" + from + ", dtype=float)\n";
}

/// A function that gives an array of these formulas.
std::string function(const std::string& name, const SystemModel& system, const Dialect& dialect,
                     const std::vector<std::string>& formulas) {
  std::vector<std::string> parameters;
  for (const Parameter& parameter : system.parameters()) parameters.push_back(parameter.name);
  std::string text = "\n\ndef " + name + "(t, state, inputs=()" +
                     (parameters.empty() ? "" : ", parameters=PARAMETERS") +
                     "):\n    t = np.float64(t)\n" +
                     unpacked(names_of(system.symbolic().states()), "state", dialect) +
                     unpacked(names_of(system.inputs()), "inputs", dialect) +
                     unpacked(parameters, "parameters", dialect) + "    return np.array([\n";
  for (const std::string& formula : formulas) text += "        " + formula + ",\n";
  return text + "    ])\n";
}

/// "NAME = (1.0, 2.0,)"
std::string constants(const std::string& name, const std::vector<double>& values) {
  std::string text = name + " = (";
  for (const double value : values) text += number_with_point(value) + ", ";
  text.pop_back();
  return text + ")\n";
}

std::string head_constants(const SystemModel& system) {
  std::string text;
  std::vector<double> values, start;
  for (const Parameter& parameter : system.parameters()) values.push_back(parameter.value);
  for (const auto& initial : system.symbolic().initial())
    start.push_back(initial ? initial->value : 0.0);
  if (!values.empty()) text += constants("PARAMETERS", values);
  if (knows_start(system.symbolic()))
    text += "# What is not known of the start is 0.\n" + constants("INITIAL", start);
  return text.empty() ? "" : "\n" + text;
}

}  // namespace

std::string export_python(const SystemModel& system) {
  const OdeModel& model = system.symbolic();
  const Dialect python = python_dialect(model);
  std::vector<std::string> rates, outputs;
  for (const Equation& equation : model.equations()) rates.push_back(code(equation, python));
  for (const Output& output : model.outputs()) outputs.push_back(code(output.formula, python));
  // The first line, or a text in the second could name an encoding (PEP 263).
  std::string text = "# -*- coding: ascii -*-\n" + heading("# ", system, python.names) +
                     "import numpy as np\n" + head_constants(system) +
                     function("rate", system, python, rates);
  return outputs.empty() ? text : text + function("output", system, python, outputs);
}

}  // namespace lacuna
