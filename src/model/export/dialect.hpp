// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/base/text.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "model/export/foreign_names.hpp"

namespace lacuna {

/// How a language writes formulas.
struct Dialect {
  std::string name;
  ForeignNames names = {};  ///< of all variables but t
  /// Calls that are not "function(a, b)" with the function's own name: from the texts of the
  /// operands.
  std::map<Operation, std::function<std::string(const std::vector<std::string>&)>> calls = {};
  /// Text of a power from the texts of base and exponent, and the exponent; nothing:
  /// base^exponent.
  std::function<std::string(const std::string&, const std::string&, const Expression&)> power =
      {};
  std::function<std::string(double)> number =
      static_cast<std::string (*)(double)>(format_number);
  std::string time = "t";
  std::string power_sign = "^";
  std::string node = {};  ///< a variable is node(name): "v"
  /// Function that makes NaN of what is no real number, around powers of exponents that are not
  /// whole; nothing: such powers are NaN.
  std::string real = {};
  /// Type that keeps quotients and powers of constants to IEEE 754; nothing: its numbers do.
  std::string scalar = {};
  bool has_delay = false;
};

/// A function of another name: asin -> arcsin.
std::function<std::string(const std::vector<std::string>&)> called(std::string function);

/// The number so that no language takes it for an integer: "2.0".
std::string number_with_point(double value);

/// Whether a formula is a whole number.
bool is_whole_number(const Expression& formula);

/// A formula in a dialect; parentheses stand where the language would compute in another order.
/// @throws ModelError for a delay where the dialect has none, for a delay whose time is no
///   number, and for parentheses that are nested too deep for compilers.
std::string code(const Expression& formula, const Dialect& dialect);

/// The right-hand side of an equation: its terms are added up in their order.
/// @throws ModelError as code() of a formula.
std::string code(const Equation& equation, const Dialect& dialect);

/// @throws ModelError for a delay whose time is still a formula of parameters.
void check_bound(const Expression& delay);

/// The name of a variable in the dialect. @throws std::out_of_range when it is not in the
/// table.
std::string code_name(const std::string& variable, const Dialect& dialect);

/// @throws ModelError where parentheses, braces or brackets are nested deeper than
///   compilers of all languages take.
void check_nesting(const std::string& code);

}  // namespace lacuna
