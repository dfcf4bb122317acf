// SPDX-License-Identifier: MIT
#include <set>

#include "lacuna/core/base/error.hpp"
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

/// "  const double th = state_[0];" for each variable that is used.
std::string locals(const SystemModel& system, const Dialect& dialect,
                   const std::set<std::string>& used) {
  const OdeModel& model = system.symbolic();
  const std::size_t own = model.inputs().size() - system.parameters().size();
  std::string text;
  const auto add = [&](const std::string& name, const std::string& array, std::size_t i) {
    if (used.contains(name))
      text += "  const double " + code_name(name, dialect) + " = " + array + "[" +
              std::to_string(i) + "];\n";
  };
  for (std::size_t i = 0; i < model.states().size(); ++i)
    add(model.states()[i].name, "state_", i);
  for (std::size_t i = 0; i < model.inputs().size(); ++i)
    add(model.inputs()[i].name, i < own ? "input_" : "lacuna_parameters", i < own ? i : i - own);
  return text;
}

std::string assignment(const std::string& array, std::size_t i, const std::string& value) {
  return "  " + array + "[" + std::to_string(i) + "] = " + value + ";\n";
}

/// From the locals to the rates.
std::string rate_body(const SystemModel& system, const Dialect& dialect) {
  const OdeModel& model = system.symbolic();
  std::string text = locals(system, dialect, names_in_rates(model));
  for (std::size_t k = 0; k < model.states().size(); ++k)
    text += assignment("rate_", k, code(model.equations()[k], dialect));
  return text;
}

std::string output_body(const SystemModel& system, const Dialect& dialect) {
  const OdeModel& model = system.symbolic();
  std::string text = locals(system, dialect, names_in_outputs(model));
  for (std::size_t i = 0; i < model.outputs().size(); ++i)
    text += assignment("output_", i, code(model.outputs()[i].formula, dialect));
  return text;
}

std::string initial_body(const OdeModel& model) {
  std::string text;
  for (std::size_t k = 0; k < model.states().size(); ++k)
    text += assignment("state_", k,
                       number_with_point(model.initial()[k] ? model.initial()[k]->value : 0.0));
  return text;
}

/// The derivatives of a rate by each state.
std::vector<Equation> derivatives(const OdeModel& model, const Equation& rate,
                                  const VariableIndex& variables) {
  std::vector<Equation> result(model.states().size());
  for (const WeightedTerm& summand : rate) {
    const std::set<std::string> used = summand.term.expression().variables();
    for (std::size_t j = 0; j < result.size(); ++j) {
      if (!used.contains(model.states()[j].name)) continue;
      const Expression slope = differentiate(summand.term.expression(), model.states()[j].name);
      if (!is_number(slope, 0.0))
        result[j].push_back({Term(slope, variables), summand.coefficient});
    }
  }
  return result;
}

/// Row by row; what is not written is 0.
std::string jacobian_body(const SystemModel& system, const Dialect& dialect) {
  const OdeModel& model = system.symbolic();
  const std::size_t m = model.states().size();
  std::string entries;
  std::set<std::string> used;
  const VariableIndex variables(model.variables());
  for (std::size_t k = 0; k < m; ++k) {
    const std::vector<Equation> slopes = derivatives(model, model.equations()[k], variables);
    for (std::size_t j = 0; j < m; ++j) {
      for (const WeightedTerm& summand : slopes[j])
        used.merge(summand.term.expression().variables());
      if (!slopes[j].empty())
        entries += assignment("jacobian_", k * m + j, code(slopes[j], dialect));
    }
  }
  return locals(system, dialect, used) + "  for (int lacuna_i = 0; lacuna_i < " +
         std::to_string(m * m) + "; ++lacuna_i) jacobian_[lacuna_i] = 0.0;\n" + entries;
}

/// A step of the method of Runge and Kutta of order 4, the inputs held.
std::string step_body(std::size_t states, const std::string& parameters) {
  const std::string m = std::to_string(states);
  return "  static const double part[3] = {0.5, 0.5, 1.0};\n"
         "  double rate_[4][" + m + "], at_[" + m + "];\n"
         "  lacuna_rate(t, state_, input_, rate_[0]" + parameters + ");\n"
         "  for (int stage = 0; stage < 3; ++stage) {\n"
         "    for (int k = 0; k < " + m + "; ++k)\n"
         "      at_[k] = state_[k] + part[stage]*step_*rate_[stage][k];\n"
         "    lacuna_rate(t + part[stage]*step_, at_, input_, rate_[stage + 1]" + parameters +
         ");\n  }\n"
         "  for (int k = 0; k < " + m + "; ++k)\n"
         "    state_[k] += step_*(rate_[0][k] + 2.0*rate_[1][k] + 2.0*rate_[2][k] +\n"
         "                        rate_[3][k])/6.0;\n";
}

/// Functions of C whose values of parameters are there.
class CFunctions {
 public:
  explicit CFunctions(ParameterPlace place)
      : parameter_(place == ParameterPlace::Argument ? ", const double lacuna_parameters[]" : ""),
        argument_(place == ParameterPlace::Argument ? ", lacuna_parameters" : "") {}

  /// @param result the array that it writes.
  std::string of(const std::string& name, const std::string& result,
                 const std::string& body) const {
    return "void " + name + "(double t, const double state_[], const double input_[], double " +
           result + "[]" + parameter_ + ") {\n  (void)t, (void)state_, (void)input_" + unused() +
           ";\n" + body + "}\n";
  }

  std::string step(std::size_t states) const {
    return "void lacuna_advance(double t, double step_, double state_[], const double input_[]" +
           parameter_ + ") {\n" + step_body(states, argument_) + "}\n";
  }

 private:
  std::string unused() const { return argument_.empty() ? "" : ", (void)lacuna_parameters"; }

  std::string parameter_, argument_;
};

std::string parameter_values(const SystemModel& system) {
  std::string values;
  for (const Parameter& parameter : system.parameters())
    values += (values.empty() ? "" : ", ") + number_with_point(parameter.value);
  return values;
}

/// "double lacuna_parameters[2] = {0.05, 0.1};": values that a program may change.
std::string parameter_array(const SystemModel& system) {
  if (system.parameters().empty()) return "";
  return "/* " + std::to_string(system.parameters().size()) +
         " parameters in the order of the head. */\ndouble lacuna_parameters[" +
         std::to_string(system.parameters().size()) + "] = {" + parameter_values(system) + "};\n\n";
}

std::string helpers_for(const std::string& text) {
  const std::string helpers = used_helpers(text, c_helpers());
  return helpers.empty() ? "" : helpers + "\n";
}

/// Derivatives nest deeper than what they are of: where compilers would not take them they are
/// left out.
std::string jacobian_function(const SystemModel& system, const Dialect& dialect,
                              const CFunctions& functions) {
  try {
    return "\n/* jacobian_[k*m + j]: rate k by state j. */\n" +
           functions.of("lacuna_jacobian", "jacobian_", jacobian_body(system, dialect));
  } catch (const ModelError&) {
    return "\n/* Left out: the Jacobian, whose formulas nest too deep. */\n";
  }
}

/// A function of C++ that gives an array.
std::string cpp_function(const SystemModel& system, const std::string& name,
                         const std::string& result, std::size_t size, const std::string& body) {
  const std::string states = std::to_string(system.symbolic().states().size());
  const std::string inputs = std::to_string(system.inputs().size());
  return "inline std::array<double, " + std::to_string(size) + "> " + name +
         "(double t, const std::array<double, " + states +
         ">& state_,\n                                      const std::array<double, " + inputs +
         ">& input_) {\n  (void)t, (void)state_, (void)input_;\n  std::array<double, " +
         std::to_string(size) + "> " + result + ";\n" + body + "  return " + result + ";\n}\n";
}

}  // namespace

std::string c_functions(const SystemModel& system, ParameterPlace place) {
  const OdeModel& model = system.symbolic();
  const Dialect dialect = c_dialect(model, "");
  const CFunctions functions(place);
  std::string text = functions.of("lacuna_rate", "rate_", rate_body(system, dialect));
  if (!model.outputs().empty())
    text += "\n" + functions.of("lacuna_output", "output_", output_body(system, dialect));
  if (knows_start(model))
    text += "\n/* What is not known of the start is 0. */\n"
            "void lacuna_initial(double state_[]) {\n" +
            initial_body(model) + "}\n";
  text += jacobian_function(system, dialect, functions) +
          "\n/* One step of Runge and Kutta's method of order 4, inputs held. */\n" +
          functions.step(model.states().size());
  return (place == ParameterPlace::File ? parameter_array(system) : "") + helpers_for(text) + text;
}

std::string export_c(const SystemModel& system) {
  const Dialect dialect = c_dialect(system.symbolic(), "");
  return heading("// ", system, dialect.names) + "#include <math.h>\n\n" +
         c_functions(system, ParameterPlace::File);
}

std::string export_cpp(const SystemModel& system) {
  const OdeModel& model = system.symbolic();
  const Dialect dialect = c_dialect(model, "std::");
  std::string text = cpp_function(system, "lacuna_rate", "rate_", model.states().size(),
                                  rate_body(system, dialect));
  if (!model.outputs().empty())
    text += "\n" + cpp_function(system, "lacuna_output", "output_", model.outputs().size(),
                                output_body(system, dialect));
  if (knows_start(model)) {
    const std::string states = std::to_string(model.states().size());
    text += "\n// What is not known of the start is 0.\ninline std::array<double, " + states +
            "> lacuna_initial() {\n  std::array<double, " + states + "> state_;\n" +
            initial_body(model) + "  return state_;\n}\n";
  }
  const std::string parameters =
      system.parameters().empty()
          ? ""
          : "// In the order of the head.\ninline std::array<double, " +
                std::to_string(system.parameters().size()) + "> lacuna_parameters = {" +
                parameter_values(system) + "};\n\n";
  return heading("// ", system, dialect.names) + "#include <array>\n#include <cmath>\n\n" +
         parameters + helpers_for(text) + text;
}

}  // namespace lacuna
