// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// How a language writes formulas.
struct Dialect {
  std::string name;
  /// Calls that are not "function(a, b)" with the function's own name: from the texts of the
  /// operands.
  std::map<Operation, std::function<std::string(const std::vector<std::string>&)>> calls = {};
  /// Text of a power; nothing: base^exponent.
  std::function<std::string(const Expression& base, const Expression& exponent)> power = {};
  /// What stands for a variable other than t; nothing: its name (code_name()).
  std::function<std::string(const std::string&)> variable = {};
  std::string time = "t";
  std::string power_sign = "^";
  bool numbers_need_a_point = false;  ///< 2 is an integer, 2.0 is not
  bool has_delay = false;
};

/// A function of another name: asin -> arcsin.
std::function<std::string(const std::vector<std::string>&)> called(std::string function);

/// A formula in a dialect, parentheses only where they are needed.
/// @throws ModelError for a delay where the dialect has none.
std::string code(const Expression& formula, const Dialect& dialect);

/// The name of a variable as a variable of the language: with an underscore behind it where it
/// is a word of some language.
std::string code_name(const std::string& variable, const Dialect& dialect);

}  // namespace lacuna
