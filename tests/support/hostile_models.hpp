// SPDX-License-Identifier: MIT
// Models whose names, units and numbers are what nobody should give.
#pragma once

#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/names.hpp"
#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::testing {

/// Stands in most hostile texts, and in no name: where a reader of the language finds it as
/// code, a text has come out of its place.
inline constexpr std::string_view kMarker = "qzevil";

/// Ends of comments, strings and lines, escapes, directives and encodings of all languages.
inline std::string hostile_text(Random& random) {
  // clang-format off
  static const std::vector<std::string> kPieces = {
      "qzevil", "qzevil", "qzevil = 1", "qzevil();", "m/s^2", "V", "\n", "\r", "\r\n", "\v",
      "\f", "\t", "\xc2\x85", "\xe2\x80\xa8", "\xe2\x80\xae", "\xe2\x81\xa6", "\xef\xbb\xbf",
      std::string(1, '\0'), "\x1a", "\x1b[31m", "\xff", "\xc3", "\xc2\xb0", "*/", "/*", "//",
      "**", "\\", "\\\n", "\?\?/", "\?\?/\n", "%{", "%}", "{", "}", "[", "]", "(", ")", "\"",
      "'", "\"\"\"", "coding: unicode_escape", "-*- coding: utf-7 -*-", "+AAo-qzevil",
      "\\u000aqzevil", "\\x0aqzevil", "\\012qzevil", "vim: set fenc=utf-7:", "^^5cqzevil",
      "^^Mqzevil", "^^", "\\input{qzevil}", "\\write18{touch qzevil}", "\\end{align*}",
      "\\catcode`\\%=12", "%", "$", "$$", "#", "&", "~", "_", "^", ".control",
      ".include qzevil", "\n.include qzevil\n", "\n+ ", "\n.ends\n", ";", "*#qzevil",
      "#define x qzevil", "\n#include \"qzevil\"\n", "@", "`", "!", "<U+0022>", "%s%n",
      "\nimport qzevil\n", "\nend\nqzevil\n", "\nequation qzevil = 1;\n", "..."};
  // clang-format on
  std::string text;
  for (std::uint64_t i = 1 + random.below(5); i > 0; --i) {
    text += kPieces[random.below(kPieces.size())];
    if (random.below(40) == 0) text.append(300, 'a');
  }
  return text;
}

/// A hostile text as far as models take it for a unit.
inline std::string hostile_unit(Random& random) {
  const std::string text = hostile_text(random);
  if (!unit_fault(text)) return text;
  const std::string cleaned = cleaned_unit(text);
  return unit_fault(cleaned) ? "V" : cleaned;
}

/// Words of all languages, names that differ little, long ones, any other.
inline std::string hostile_name(Random& random) {
  // clang-format off
  static const std::vector<std::string> kNames = {
      "x", "X", "x_", "X_", "x_2", "x1", "_x", "__x", "_", "__", "y", "e", "E", "e1", "i",
      "I", "j", "v", "V", "d", "D", "lambda", "lambda_", "Lambda", "void", "struct",
      "return", "fabs", "pow", "NULL", "state_", "state", "State", "input", "inputs",
      "input_", "rate", "rate_", "from", "None", "gnd", "GND", "Gnd", "time", "Time", "TIME",
      "temper", "hertz", "np", "numpy", "std", "end", "End", "function", "der", "model",
      "equation", "Real", "double", "int", "auto", "class", "operator", "constexpr",
      "co_await", "NAN", "INFINITY", "HUGE_VAL", "M_PI", "FP_NAN", "EOF", "linux", "unix",
      "y0", "j1", "gamma", "and", "not_eq", "bitor", "case", "match", "print", "exec",
      "import", "ans", "eps", "Inf", "NaN", "nargin", "disp", "clear", "eval", "system",
      "lacuna_rate", "lacuna_min", "lacuna_real", "lacuna_model", "LacunaModel", "floor",
      "mod", "pre", "initial", "smooth", "transpose", "temp", "m", "tc1", "ic", "off",
      "params", "param", "poly", "table", "value", "null", "meg", "vol", "cur", "table_",
      "pwr", "sgn", "ln", "log10", "sinh", "u", "pulse", "dc", "ac", "tran", "subckt",
      "ends", "control", "include", "input2", "mathit", "dot", "left", "right", "frac",
      "begin", "def", "e10", "x00", "__import__", "__FILE__", "_Bool", "_Complex",
      "__init__", "true", "True", "i386", "t1", "T", "Pi", "PI"};
  // clang-format on
  const std::uint64_t kind = random.below(12);
  if (kind == 0) return std::string(40 + random.below(60), 'a') + (random.below(2) ? "1" : "2");
  if (kind > 1) return kNames[random.below(kNames.size())];
  std::string name(1, "abcxyzABCXYZ_"[random.below(13)]);
  for (std::uint64_t i = random.below(6); i > 0; --i) name += "abXY_01"[random.below(7)];
  return name;
}

/// Names of a model, all different.
inline std::vector<std::string> hostile_names(std::size_t count, std::set<std::string>& taken,
                                              Random& random) {
  std::vector<std::string> names;
  while (names.size() < count) {
    const std::string name = hostile_name(random);
    try {
      Expression::variable(name);  // not a word of the formula language
    } catch (const ModelError&) {
      continue;
    }
    if (taken.insert(name).second) names.push_back(name);
  }
  return names;
}

inline double hostile_coefficient(Random& random) {
  constexpr std::array<double, 8> kNumbers = {1, -1, 2, 1e-5, 3e9, 9.81, 1e20, 12345678901};
  return random.below(3) == 0 ? kNumbers[random.below(kNumbers.size())]
                              : random.uniform(-3.0, 3.0);
}

/// A formula with all operations in names and t.
inline Expression hostile_formula(const std::vector<std::string>& names, int depth,
                                  Random& random) {
  if (depth == 0 || random.below(6) == 0) {
    const std::uint64_t kind = random.below(names.size() + 2);
    if (kind < names.size()) return Expression::variable(names[kind]);
    return kind == names.size() ? Expression::variable("t")
                                : Expression::number(random.uniform(-3.0, 3.0));
  }
  constexpr auto kFirst = static_cast<std::uint64_t>(Operation::Add);
  constexpr auto kLast = static_cast<std::uint64_t>(Operation::Clip);
  const auto operation = static_cast<Operation>(kFirst + random.below(kLast - kFirst + 1));
  const auto operand = [&] { return hostile_formula(names, depth - 1, random); };
  const auto inside = [&](double low, double high) {  // mostly
    if (random.below(6) == 0) return operand();
    return Expression::make(Operation::Clip,
                            {operand(), Expression::number(low), Expression::number(high)});
  };
  constexpr std::array<double, 10> kExponents = {-3, -2, -1, 0.5, 1, 2, 3, 5, 10, 11};
  if (operation == Operation::Power && random.below(2) == 0)
    return Expression::make(
        operation,
        {operand(), Expression::number(kExponents[random.below(kExponents.size())])});
  if (operation == Operation::Power)
    return Expression::make(operation, {inside(0.1, 3.0), operand()});
  if (operation == Operation::Sqrt || operation == Operation::Log)
    return Expression::make(operation, {inside(0.1, 100.0)});
  if (operation == Operation::Asin || operation == Operation::Acos)
    return Expression::make(operation, {inside(-0.9, 0.9)});
  if (operation == Operation::Clip)
    return Expression::make(operation, {operand(), operand(), operand()});
  const bool is_binary = operation < Operation::Negate || operation == Operation::Min ||
                         operation == Operation::Max;
  return is_binary ? Expression::make(operation, {operand(), operand()})
                   : Expression::make(operation, {operand()});
}

/// Texts as units where models take them.
inline std::vector<Quantity> hostile_quantities(const std::vector<std::string>& names,
                                                Random& random) {
  std::vector<Quantity> quantities;
  for (const std::string& name : names) quantities.push_back({name, hostile_unit(random)});
  return quantities;
}

/// A model of one to four states, up to three inputs and outputs; units are hostile texts.
/// @throws ModelError where a model refuses what was drawn.
inline OdeModel hostile_model(Random& random) {
  std::set<std::string> taken;
  const std::vector<std::string> states = hostile_names(1 + random.below(4), taken, random);
  const std::vector<std::string> inputs = hostile_names(random.below(4), taken, random);
  const std::vector<std::string> outputs = hostile_names(random.below(2), taken, random);
  const Variables variables{states, inputs};
  std::vector<std::string> names = states;
  names.insert(names.end(), inputs.begin(), inputs.end());
  std::vector<Equation> equations(states.size());
  for (Equation& equation : equations) {
    std::set<std::string> terms;
    for (std::uint64_t i = random.below(4); i > 0; --i) {
      const Term term(hostile_formula(names, 4, random), variables);
      if (terms.insert(term.name()).second)
        equation.push_back({term, hostile_coefficient(random)});
    }
  }
  const OdeModel model(hostile_quantities(states, random), hostile_quantities(inputs, random),
                       equations, hostile_unit(random));
  std::vector<Output> channels;
  for (const std::string& name : outputs)
    channels.push_back({name, hostile_unit(random), hostile_formula(names, 2, random)});
  return model.with_outputs(channels);
}

}  // namespace lacuna::testing
