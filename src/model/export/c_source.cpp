// SPDX-License-Identifier: MIT
#include "model/export/dialect.hpp"
#include "model/export/heading.hpp"
#include "model/export/languages.hpp"
#include "model/export/sources.hpp"
#include "model/expressions/operations.hpp"

namespace lacuna {
namespace {

/// Functions that C has not, or has with another answer to nan.
const std::vector<std::pair<std::string, std::string>>& c_helpers() {
  static const std::vector<std::pair<std::string, std::string>> helpers = {
      {"lacuna_sign",
       "static inline double lacuna_sign(double v) {\n"
       "  return v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : v;\n}\n"},
      {"lacuna_step",
       "static inline double lacuna_step(double v) {\n"
       "  return v >= 0.0 ? 1.0 : v < 0.0 ? 0.0 : v;\n}\n"},
      {"lacuna_min",
       "static inline double lacuna_min(double v, double w) {\n"
       "  return v < w || v != v ? v : w;\n}\n"},
      {"lacuna_max",
       "static inline double lacuna_max(double v, double w) {\n"
       "  return v > w || v != v ? v : w;\n}\n"}};
  return helpers;
}

/// @param space in front of the functions of the language: "std::".
Dialect c_dialect(const OdeModel& model, const std::string& space) {
  Dialect c{.name = "C", .names = foreign_names(model, c_names()), .number = number_with_point};
  for (const std::string& function : function_names())
    c.calls[*function_named(function)] = called(space + function);
  c.calls[Operation::Abs] = called(space + "fabs");
  c.calls[Operation::Sign] = called("lacuna_sign");
  c.calls[Operation::Step] = called("lacuna_step");
  c.calls[Operation::Min] = called("lacuna_min");
  c.calls[Operation::Max] = called("lacuna_max");
  c.calls[Operation::Clip] = [](const std::vector<std::string>& o) {
    return "lacuna_min(lacuna_max(" + o[0] + ", " + o[1] + "), " + o[2] + ")";
  };
  c.power = [space](const std::string& base, const std::string& exponent, const Expression&) {
    return space + "pow(" + base + ", " + exponent + ")";
  };
  return c;
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

/// From the locals to the rates.
std::string body(const OdeModel& model, const Dialect& dialect) {
  std::string text = locals(model, dialect);
  for (std::size_t k = 0; k < model.states().size(); ++k)
    text +=
        "  rate_[" + std::to_string(k) + "] = " + code(model.equations()[k], dialect) + ";\n";
  return text;
}

std::string helpers_for(const std::string& text) {
  const std::string helpers = used_helpers(text, c_helpers());
  return helpers.empty() ? "" : helpers + "\n";
}

}  // namespace

std::string export_c(const OdeModel& model) {
  const Dialect dialect = c_dialect(model, "");
  const std::string text = body(model, dialect);
  return heading("// ", model, dialect.names) + "#include <math.h>\n\n" + helpers_for(text) +
         "void lacuna_rate(double t, const double state_[], const double input_[], double "
         "rate_[]) {\n  (void)t, (void)state_, (void)input_;\n" +
         text + "}\n";
}

std::string export_cpp(const OdeModel& model) {
  const Dialect dialect = c_dialect(model, "std::");
  const std::string states = std::to_string(model.states().size());
  const std::string inputs = std::to_string(model.inputs().size());
  const std::string text = body(model, dialect);
  return heading("// ", model, dialect.names) + "#include <array>\n#include <cmath>\n\n" +
         helpers_for(text) + "inline std::array<double, " + states +
         "> lacuna_rate(double t, const std::array<double, " + states +
         ">& state_,\n                                      const std::array<double, " +
         inputs +
         ">& input_) {\n  (void)t, (void)state_, (void)input_;\n  std::array<double, " +
         states + "> rate_;\n" + text + "  return rate_;\n}\n";
}

}  // namespace lacuna
