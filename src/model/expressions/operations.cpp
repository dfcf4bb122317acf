// SPDX-License-Identifier: MIT
#include "operations.hpp"

#include <algorithm>
#include <limits>

namespace lacuna {
namespace {

struct Function {
  Operation operation;
  std::string_view name;
};

constexpr std::array kFunctions{
    Function{Operation::Sin, "sin"},    Function{Operation::Cos, "cos"},
    Function{Operation::Tan, "tan"},    Function{Operation::Asin, "asin"},
    Function{Operation::Acos, "acos"},  Function{Operation::Atan, "atan"},
    Function{Operation::Tanh, "tanh"},  Function{Operation::Exp, "exp"},
    Function{Operation::Log, "log"},    Function{Operation::Sqrt, "sqrt"},
    Function{Operation::Abs, "abs"},    Function{Operation::Sign, "sign"},
    Function{Operation::Step, "step"},  Function{Operation::Min, "min"},
    Function{Operation::Max, "max"},    Function{Operation::Clip, "clip"},
    Function{Operation::Delay, "delay"}};

struct CountOperands {
  int count = 0;
  template <class F>
  void unary(F) {
    count = 1;
  }
  template <class F>
  void binary(F) {
    count = 2;
  }
  template <class F>
  void ternary(F) {
    count = 3;
  }
};

struct ApplyOnce {
  const std::array<double, 3>& operands;
  double result = std::numeric_limits<double>::quiet_NaN();
  template <class F>
  void unary(F f) {
    result = f(operands[0]);
  }
  template <class F>
  void binary(F f) {
    result = f(operands[0], operands[1]);
  }
  template <class F>
  void ternary(F f) {
    result = f(operands[0], operands[1], operands[2]);
  }
};

}  // namespace

int arity(Operation operation) noexcept {
  CountOperands counter;
  with_function(operation, counter);
  return counter.count;
}

std::string_view function_name(Operation operation) noexcept {
  const auto found = std::find_if(kFunctions.begin(), kFunctions.end(),
                                  [&](const Function& f) { return f.operation == operation; });
  return found == kFunctions.end() ? std::string_view{} : found->name;
}

std::optional<Operation> function_named(std::string_view name) noexcept {
  const auto found = std::find_if(kFunctions.begin(), kFunctions.end(),
                                  [&](const Function& f) { return f.name == name; });
  if (found == kFunctions.end()) return std::nullopt;
  return found->operation;
}

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const Function& function : kFunctions) names.emplace_back(function.name);
  return names;
}

double apply_operation(Operation operation, const std::array<double, 3>& operands) noexcept {
  ApplyOnce once{operands};
  with_function(operation, once);
  return once.result;
}

std::optional<double> constant_value(const Expression& expression) {
  if (expression.operation() == Operation::Number) return expression.value();
  if (expression.operands().empty()) return std::nullopt;
  std::array<double, 3> values{};
  std::size_t count = 0;
  for (const Expression& operand : expression.operands()) {
    const std::optional<double> value = constant_value(operand);
    if (!value) return std::nullopt;
    values[count++] = *value;
  }
  return apply_operation(expression.operation(), values);
}

bool has_any(const Expression& expression, const std::set<std::string>& names) {
  const std::set<std::string> used = expression.variables();
  return std::any_of(used.begin(), used.end(),
                     [&](const std::string& name) { return names.contains(name); });
}

}  // namespace lacuna
