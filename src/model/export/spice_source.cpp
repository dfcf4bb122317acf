// SPDX-License-Identifier: MIT
#include <cmath>

#include "model/export/dialect.hpp"
#include "model/export/heading.hpp"
#include "model/export/languages.hpp"
#include "model/export/quoted_text.hpp"
#include "model/export/sources.hpp"

namespace lacuna {
namespace {

/// ngspice takes 11 digits of a number in an expression: one with more is the sum of two.
std::string spice_number(double value) {
  // More than coefficients are known to.
  constexpr int kDigits = 10;
  const std::string begin = format_number(value, kDigits);
  const double rest = value - parse_number(begin).value_or(value);
  if (rest == 0.0 || !std::isfinite(rest)) return format_number(value);
  return "(" + begin + (rest < 0.0 ? " - " : " + ") + format_number(std::abs(rest), kDigits) +
         ")";
}

/// Longest text that is repeated, so that powers of powers of powers stay short.
constexpr std::size_t kLongestFactor = 200;

/// ngspice's pow(x, y) is |x|^y, its pwr(x, y) is sign(x)*|x|^y. Short bases are multiplied,
/// which every simulator does alike.
std::string whole_power(const std::string& base, int exponent) {
  // For people: longer products are powers.
  constexpr int kMostFactors = 9;
  const int size = std::abs(exponent);
  std::string product = "1";
  if (size > kMostFactors || base.size() > kLongestFactor)
    product = (size % 2 == 0 ? "pow(" : "pwr(") + base + ", " + std::to_string(size) + ")";
  else
    for (int i = 0; i < size; ++i) product += "*(" + base + ")";
  return exponent < 0 ? "(1/(" + product + "))" : "(" + product + ")";
}

/// Below 0 a power that is not whole is an error of sqrt or ln.
std::string spice_power(const std::string& base, const std::string& exponent,
                        const Expression& formula) {
  // A fact of doubles: higher powers are 0 or infinite.
  constexpr double kLargestPower = 1000.0;
  if (is_whole_number(formula) && std::abs(formula.value()) <= kLargestPower)
    return whole_power(base, static_cast<int>(formula.value()));
  if (is_number(formula, 0.5)) return "sqrt(" + base + ")";
  if (base.size() > kLongestFactor) return "exp((" + exponent + ")*ln(" + base + "))";
  return "((" + base + ") >= 0 ? pow(" + base + ", " + exponent + ") : sqrt(" + base + "))";
}

Dialect spice_dialect(const OdeModel& model) {
  Dialect spice{.name = "SPICE",
                .names = foreign_names(model, spice_names()),
                .power = spice_power,
                .number = spice_number,
                .time = "time",
                .node = "v"};
  spice.calls = {
      {Operation::Log, called("ln")},
      {Operation::Sign, called("sgn")},
      {Operation::Step,
       [](const std::vector<std::string>& o) { return "((" + o[0] + ") >= 0 ? 1 : 0)"; }},
      {Operation::Clip, [](const std::vector<std::string>& o) {
         return "min(max(" + o[0] + ", " + o[1] + "), " + o[2] + ")";
       }}};
  return spice;
}

/// Parameters are numbers here.
std::string parameter_lines(const SystemModel& system) {
  std::vector<std::string> texts;
  for (const Parameter& parameter : system.parameters())
    texts.push_back(quoted_text(parameter.name) + " = " + format_number(parameter.value));
  return texts.empty() ? "" : comment_lines("* ", "Numbers for: " + join(texts, ", ") + ".");
}

}  // namespace

std::string export_spice(const SystemModel& system) {
  // A number in an expression has eleven digits, a parameter too: parameters become numbers.
  const OdeModel model = system.model();
  const Dialect spice = spice_dialect(model);
  std::string ports, text;
  for (const Quantity& input : model.inputs()) ports += " " + code_name(input.name, spice);
  for (std::size_t k = 0; k < model.states().size(); ++k) {
    const std::string name = code_name(model.states()[k].name, spice);
    ports += " " + name;
    const std::string start =
        model.initial()[k] ? " ic=" + format_number(model.initial()[k]->value) : "";
    text += "C" + name + " " + name + " 0 1" + start + "\nB" + name + " 0 " + name +
            " I=" + code(model.equations()[k], spice) + "\n";
  }
  for (const Output& output : model.outputs()) {
    if (state_of(model, output)) continue;
    const std::string name = code_name(output.name, spice);
    ports += " " + name;
    text += "B" + name + " " + name + " 0 V=" + code(output.formula, spice) + "\n";
  }
  return heading("* ", model, spice.names) + parameter_lines(system) +
         comment_lines("* ", "States are voltages of 1 F; ports are inputs, states, outputs.") +
         ".subckt lacuna_model" + ports + "\n" + text + ".ends\n";
}

}  // namespace lacuna
