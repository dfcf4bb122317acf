// SPDX-License-Identifier: MIT
#include "lacuna/model/export/export_model.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/text.hpp"
#include "model/export/dialect.hpp"
#include "model/export/latex.hpp"

namespace lacuna {
namespace {

using Operands = std::vector<std::string>;

/// sum of coefficient x term, as one formula.
Expression right_hand_side(const Equation& equation) {
  std::optional<Expression> sum;
  for (const WeightedTerm& one : equation) {
    const bool negative = sum && one.coefficient < 0.0;
    const double size = negative ? -one.coefficient : one.coefficient;
    const Expression& term = one.term.expression();
    const Expression summand = one.term.name() == "1" ? Expression::number(size)
                               : size == 1.0          ? term
                               : size == -1.0 ? Expression::make(Operation::Negate, {term})
                                              : Expression::number(size) * term;
    if (!sum)
      sum = summand;
    else
      sum = Expression::make(negative ? Operation::Subtract : Operation::Add, {*sum, summand});
  }
  return sum.value_or(Expression::number(0.0));
}

std::string rate(const OdeModel& model, std::size_t k, const Dialect& dialect) {
  return code(right_hand_side(model.equations()[k]), dialect);
}

/// What a quantity is, for a comment: "th [rad]".
std::string with_unit(const Quantity& quantity) {
  return quantity.name + (quantity.unit.empty() ? "" : " [" + quantity.unit + "]");
}

std::string names_with_units(const std::vector<Quantity>& quantities) {
  std::vector<std::string> texts;
  for (const Quantity& quantity : quantities) texts.push_back(with_unit(quantity));
  return texts.empty() ? "none" : join(texts, ", ");
}

/// Comment lines that say what goes in and what comes out.
std::string heading(const OdeModel& model, const std::string& begin) {
  const std::string time = model.time_unit().empty() ? "" : " [" + model.time_unit() + "]";
  return begin + "Rates of a system of ordinary differential equations; time t" + time + ".\n" +
         begin + "States: " + names_with_units(model.states()) + ".\n" + begin +
         "Inputs: " + names_with_units(model.inputs()) + ".\n";
}

/// Names that the right-hand sides use.
std::set<std::string> used_names(const OdeModel& model) {
  std::set<std::string> names;
  for (const Equation& equation : model.equations())
    for (const WeightedTerm& summand : equation)
      names.merge(summand.term.expression().variables());
  return names;
}

/// "  const double th = state_[0];" for each variable that is used.
std::string locals(const OdeModel& model, const Dialect& dialect) {
  const std::set<std::string> used = used_names(model);
  std::string text;
  const auto add = [&](const std::vector<Quantity>& quantities, const std::string& array) {
    for (std::size_t i = 0; i < quantities.size(); ++i)
      if (used.contains(quantities[i].name))
        text += "  const double " + code_name(quantities[i].name, dialect) + " = " + array +
                "[" + std::to_string(i) + "];\n";
  };
  add(model.states(), "state_");
  add(model.inputs(), "input_");
  return text;
}

std::string assignments(const OdeModel& model, const Dialect& dialect, const std::string& open,
                        const std::string& close) {
  std::string text;
  for (std::size_t k = 0; k < model.states().size(); ++k)
    text += open + std::to_string(k) + close + rate(model, k, dialect) + ";\n";
  return text;
}

Dialect c_dialect() {
  Dialect c{.name = "C", .numbers_need_a_point = true};
  c.calls = {{Operation::Abs, called("fabs")},
             {Operation::Sign, called("lacuna_sign")},
             {Operation::Step, called("lacuna_step")},
             {Operation::Min, called("fmin")},
             {Operation::Max, called("fmax")},
             {Operation::Clip, [](const Operands& o) {
                return "fmin(fmax(" + o[0] + ", " + o[1] + "), " + o[2] + ")";
              }}};
  c.power = [](const Expression& base, const Expression& exponent) {
    const Dialect same = c_dialect();
    return "pow(" + code(base, same) + ", " + code(exponent, same) + ")";
  };
  return c;
}

constexpr const char* kSwitches =
    "static inline double lacuna_sign(double v) { return (v > 0.0) - (v < 0.0); }\n"
    "static inline double lacuna_step(double v) { return v < 0.0 ? 0.0 : 1.0; }\n";

std::string export_c(const OdeModel& model) {
  const Dialect dialect = c_dialect();
  return heading(model, "// ") + "#include <math.h>\n\n" + kSwitches +
         "\nvoid lacuna_rate(double t, const double state_[], const double input_[], double "
         "rate_[]) {\n  (void)t, (void)state_, (void)input_;\n" +
         locals(model, dialect) + assignments(model, dialect, "  rate_[", "] = ") + "}\n";
}

std::string export_cpp(const OdeModel& model) {
  const Dialect dialect = c_dialect();
  const std::string states = std::to_string(model.states().size());
  const std::string inputs = std::to_string(model.inputs().size());
  return heading(model, "// ") + "#include <array>\n#include <cmath>\n\n" + kSwitches +
         "\ninline std::array<double, " + states +
         "> lacuna_rate(double t, const std::array<double, " + states +
         ">& state_,\n                                      const std::array<double, " +
         inputs + ">& input_) {\n  using namespace std;\n" +
         "  (void)t, (void)state_, (void)input_;\n" + locals(model, dialect) +
         "  std::array<double, " + states + "> rate_;\n" +
         assignments(model, dialect, "  rate_[", "] = ") + "  return rate_;\n}\n";
}

std::string export_python(const OdeModel& model) {
  Dialect python{.name = "Python", .power_sign = "**"};
  for (const auto& [operation, function] :
       std::map<Operation, const char*>{{Operation::Sin, "np.sin"},
                                        {Operation::Cos, "np.cos"},
                                        {Operation::Tan, "np.tan"},
                                        {Operation::Asin, "np.arcsin"},
                                        {Operation::Acos, "np.arccos"},
                                        {Operation::Atan, "np.arctan"},
                                        {Operation::Tanh, "np.tanh"},
                                        {Operation::Exp, "np.exp"},
                                        {Operation::Log, "np.log"},
                                        {Operation::Sqrt, "np.sqrt"},
                                        {Operation::Abs, "np.abs"},
                                        {Operation::Sign, "np.sign"},
                                        {Operation::Min, "np.minimum"},
                                        {Operation::Max, "np.maximum"},
                                        {Operation::Clip, "np.clip"}})
    python.calls[operation] = called(function);
  python.calls[Operation::Step] = [](const Operands& o) {
    return "np.heaviside(" + o[0] + ", 1.0)";
  };
  std::string text =
      heading(model, "# ") + "import numpy as np\n\n\n" + "def rate(t, state, inputs=()):\n";
  const auto unpack = [&](const std::vector<Quantity>& quantities, const std::string& from) {
    std::string names;
    for (const Quantity& one : quantities) names += code_name(one.name, python) + ", ";
    if (!names.empty())
      text += "    " + names.substr(0, names.size() - 1) + " = " + from + "\n";
  };
  unpack(model.states(), "state");
  unpack(model.inputs(), "inputs");
  text += "    return np.array([\n";
  for (std::size_t k = 0; k < model.states().size(); ++k)
    text += "        " + rate(model, k, python) + ",\n";
  return text + "    ])\n";
}

std::string export_matlab(const OdeModel& model) {
  Dialect matlab{.name = "MATLAB"};
  matlab.calls[Operation::Step] = [](const Operands& o) { return "double(" + o[0] + " >= 0)"; };
  matlab.calls[Operation::Clip] = [](const Operands& o) {
    return "min(max(" + o[0] + ", " + o[1] + "), " + o[2] + ")";
  };
  std::string text = "function rate = lacuna_rate(t, state, input)\n" + heading(model, "% ");
  const auto unpack = [&](const std::vector<Quantity>& quantities, const std::string& from) {
    for (std::size_t i = 0; i < quantities.size(); ++i)
      text += "  " + code_name(quantities[i].name, matlab) + " = " + from + "(" +
              std::to_string(i + 1) + ");\n";
  };
  unpack(model.states(), "state");
  unpack(model.inputs(), "input");
  text += "  rate = [\n";
  for (std::size_t k = 0; k < model.states().size(); ++k)
    text += "    (" + rate(model, k, matlab) + ")\n";
  return text + "  ];\nend\n";
}

std::string export_modelica(const OdeModel& model) {
  Dialect modelica{.name = "Modelica", .time = "time", .has_delay = true};
  modelica.calls[Operation::Step] = [](const Operands& o) {
    return "(if " + o[0] + " >= 0 then 1.0 else 0.0)";
  };
  modelica.calls[Operation::Clip] = [](const Operands& o) {
    return "min(max(" + o[0] + ", " + o[1] + "), " + o[2] + ")";
  };
  const auto declared = [&](const Quantity& quantity, const std::string& kind) {
    return "  " + kind + "Real " + code_name(quantity.name, modelica) +
           (quantity.unit.empty() ? "" : "(unit=\"" + quantity.unit + "\")") + ";\n";
  };
  std::string text = "model LacunaModel\n";
  for (const Quantity& input : model.inputs()) text += declared(input, "input ");
  for (const Quantity& state : model.states()) text += declared(state, "");
  text += "equation\n";
  for (std::size_t k = 0; k < model.states().size(); ++k)
    text += "  der(" + code_name(model.states()[k].name, modelica) +
            ") = " + rate(model, k, modelica) + ";\n";
  return text + "end LacunaModel;\n";
}

/// Whole powers as products: ngspice takes the absolute value of a base.
std::string spice_power(const Expression& base, const Expression& exponent,
                        const Dialect& dialect) {
  constexpr double kMost = 9.0;
  const std::string text = "(" + code(base, dialect) + ")";
  if (exponent.operation() != Operation::Number || std::abs(exponent.value()) > kMost ||
      exponent.value() != std::floor(exponent.value()))
    return "pow(" + text + ", " + code(exponent, dialect) + ")";
  std::string product = "1";
  for (int i = 0; i < static_cast<int>(std::abs(exponent.value())); ++i) product += "*" + text;
  return exponent.value() < 0.0 ? "(1/(" + product + "))" : "(" + product + ")";
}

Dialect spice_dialect() {
  Dialect spice{.name = "SPICE", .time = "time"};
  spice.variable = [](const std::string& name) { return "v(" + name + ")"; };
  spice.calls = {
      {Operation::Log, called("ln")},
      {Operation::Sign, called("sgn")},
      {Operation::Step, [](const Operands& o) { return "((" + o[0] + ") >= 0 ? 1 : 0)"; }},
      {Operation::Clip,
       [](const Operands& o) { return "min(max(" + o[0] + ", " + o[1] + "), " + o[2] + ")"; }}};
  spice.power = [](const Expression& base, const Expression& exponent) {
    return spice_power(base, exponent, spice_dialect());
  };
  return spice;
}

std::string export_spice(const OdeModel& model) {
  const Dialect spice = spice_dialect();
  std::string ports, text;
  for (const Quantity& input : model.inputs()) ports += " " + input.name;
  for (std::size_t k = 0; k < model.states().size(); ++k) {
    const std::string& name = model.states()[k].name;
    ports += " " + name;
    text += "C" + name + " " + name + " 0 1\nB" + name + " 0 " + name +
            " I=" + rate(model, k, spice) + "\n";
  }
  return "* States are voltages of 1 F; inputs: " + names_with_units(model.inputs()) +
         "\n.subckt lacuna_model" + ports + "\n" + text + ".ends\n";
}

using Exporter = std::string (*)(const OdeModel&);

const std::map<std::string, Exporter>& exporters() {
  static const std::map<std::string, Exporter> all = {
      {"c", export_c},           {"cpp", export_cpp},           {"latex", export_latex},
      {"matlab", export_matlab}, {"modelica", export_modelica}, {"python", export_python},
      {"spice", export_spice}};
  return all;
}

}  // namespace

std::vector<std::string> export_formats() {
  std::vector<std::string> names;
  for (const auto& [name, exporter] : exporters()) names.push_back(name);
  return names;
}

std::string export_model(const OdeModel& model, const std::string& format) {
  const auto found = exporters().find(format);
  if (found == exporters().end())
    throw ConfigError("export", "there is no format '" + format + "'",
                      suggestion(format, export_formats()));
  check_flow(model, "export");
  return found->second(model);
}

}  // namespace lacuna
