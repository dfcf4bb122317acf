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
std::string unpacked(const std::vector<Quantity>& quantities, const std::string& from,
                     const Dialect& dialect) {
  std::string names;
  for (const Quantity& one : quantities) names += code_name(one.name, dialect) + ", ";
  if (names.empty()) return "";
  names.pop_back();
  return "    " + names + " = np.asarray(" + from + ", dtype=float)\n";
}

}  // namespace

std::string export_python(const OdeModel& model) {
  const Dialect python = python_dialect(model);
  // The first line, or a text in the second could name an encoding (PEP 263).
  std::string text = "# -*- coding: ascii -*-\n" + heading("# ", model, python.names) +
                     "import numpy as np\n\n\ndef rate(t, state, inputs=()):\n"
                     "    t = np.float64(t)\n" +
                     unpacked(model.states(), "state", python) +
                     unpacked(model.inputs(), "inputs", python) + "    return np.array([\n";
  for (const Equation& equation : model.equations())
    text += "        " + code(equation, python) + ",\n";
  return text + "    ])\n";
}

}  // namespace lacuna
