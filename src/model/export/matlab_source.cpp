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
std::string taken_from(const std::string& vector, const std::vector<Quantity>& quantities,
                       const Dialect& dialect) {
  std::string text;
  for (std::size_t i = 0; i < quantities.size(); ++i)
    text += "  " + code_name(quantities[i].name, dialect) + " = " + vector + "(" +
            std::to_string(i + 1) + ");\n";
  return text;
}

}  // namespace

std::string export_matlab(const OdeModel& model) {
  const Dialect matlab = matlab_dialect(model);
  std::string rates;
  for (const Equation& equation : model.equations())
    rates += "    (" + code(equation, matlab) + ")\n";
  return "function rate = lacuna_rate(t, state, input)\n" + heading("% ", model, matlab.names) +
         taken_from("state", model.states(), matlab) +
         taken_from("input", model.inputs(), matlab) + "  rate = [\n" + rates + "  ];\nend\n" +
         used_helpers(rates, matlab_helpers());
}

}  // namespace lacuna
