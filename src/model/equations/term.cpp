// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/term.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "model/expressions/operations.hpp"

namespace lacuna {
namespace {

/// Exponents that are not 0, by slot.
using Powers = std::map<Index, int>;

/// Beyond it a power is no monomial of any library, and sums of exponents cannot overflow.
constexpr int kLargestExponent = 1000;

std::optional<Powers> bounded(Powers powers) {
  std::erase_if(powers, [](const auto& power) { return power.second == 0; });
  for (const auto& [slot, exponent] : powers)
    if (std::abs(exponent) > kLargestExponent) return std::nullopt;
  return powers;
}

/// Reads an expression as a product of integer powers of the variables.
class MonomialReader {
 public:
  explicit MonomialReader(const VariableIndex& variables) : variables_(variables) {}

  std::optional<Powers> read(const Expression& e) const {
    switch (e.operation()) {
      case Operation::Number:
        if (e.value() != 1.0) return std::nullopt;
        return Powers{};
      case Operation::Variable:
        if (const auto slot = variables_.find(e.name())) return Powers{{*slot, 1}};
        return std::nullopt;
      case Operation::Multiply:
        return of_product(e, 1);
      case Operation::Divide:
        return of_product(e, -1);
      case Operation::Power:
        return of_power(e);
      default:
        return std::nullopt;
    }
  }

 private:
  std::optional<Powers> of_product(const Expression& e, int sign) const {
    std::optional<Powers> first = read(e.operands()[0]);
    if (!first) return std::nullopt;
    const std::optional<Powers> second = read(e.operands()[1]);
    if (!second) return std::nullopt;
    for (const auto& [slot, exponent] : *second) (*first)[slot] += sign * exponent;
    return bounded(std::move(*first));
  }

  std::optional<Powers> of_power(const Expression& e) const {
    const Expression& exponent = e.operands()[1];
    if (exponent.operation() != Operation::Number) return std::nullopt;
    const double power = exponent.value();
    if (power != std::floor(power) || std::abs(power) > kLargestExponent) return std::nullopt;
    std::optional<Powers> base = read(e.operands()[0]);
    if (!base) return std::nullopt;
    for (auto& [slot, entry] : *base) entry *= static_cast<int>(power);
    return bounded(std::move(*base));
  }

  const VariableIndex& variables_;
};

Expression power(const std::string& name, int exponent) {
  const Expression variable = Expression::variable(name);
  if (exponent == 1) return variable;
  return Expression::make(Operation::Power, {variable, Expression::number(exponent)});
}

Expression monomial_expression(const Powers& powers, const std::vector<std::string>& names) {
  std::optional<Expression> product;
  for (const auto& [slot, exponent] : powers) {
    const Expression factor = power(names[static_cast<std::size_t>(slot)], exponent);
    product = product ? *product * factor : factor;
  }
  return product.value_or(Expression::number(1.0));
}

void check_names(const Expression& expression, const VariableIndex& variables) {
  for (const std::string& name : expression.variables())
    if (!variables.find(name))
      throw ModelError("term '" + expression.to_string() + "'", "unknown name '" + name + "'",
                       suggestion(name, variables.names()));
}

}  // namespace

Term::Term(const Expression& expression, const Variables& variables)
    : Term(expression, VariableIndex(variables)) {}

Term::Term(const Expression& expression, const VariableIndex& variables)
    : expression_(expression), slots_(static_cast<Index>(variables.names().size())) {
  check_names(expression, variables);
  powers_ = MonomialReader(variables).read(expression);
  if (powers_) expression_ = monomial_expression(*powers_, variables.names());
  name_ = expression_.to_string();
}

std::optional<std::vector<int>> Term::exponents() const {
  if (!powers_) return std::nullopt;
  std::vector<int> exponents(static_cast<std::size_t>(slots_), 0);
  for (const auto& [slot, exponent] : *powers_)
    exponents[static_cast<std::size_t>(slot)] = exponent;
  return exponents;
}

std::optional<Index> Term::variable() const noexcept {
  if (!powers_ || powers_->size() != 1 || powers_->begin()->second != 1) return std::nullopt;
  return powers_->begin()->first;
}

Term Term::parse(std::string_view text, const Variables& variables) {
  const VariableIndex index(variables);
  return Term(parse_expression(text, index.names()), index);
}

Term Term::monomial(const std::vector<int>& exponents, const Variables& variables) {
  if (static_cast<Index>(exponents.size()) != variables.count())
    throw ArgumentError("Term::monomial",
                        std::to_string(exponents.size()) + " exponents for " +
                            std::to_string(variables.count()) + " variables",
                        "give one exponent per variable, time last");
  Powers powers;
  for (std::size_t i = 0; i < exponents.size(); ++i)
    if (exponents[i] != 0) powers.emplace(static_cast<Index>(i), exponents[i]);
  const VariableIndex index(variables);
  return Term(monomial_expression(powers, index.names()), index);
}

std::vector<std::string> TermLibrary::names() const {
  std::vector<std::string> names;
  names.reserve(terms.size());
  for (const Term& term : terms) names.push_back(term.name());
  return names;
}

Program TermLibrary::compile() const {
  std::vector<Expression> expressions;
  expressions.reserve(terms.size());
  for (const Term& term : terms) expressions.push_back(term.expression());
  return Program(expressions, variables);
}

}  // namespace lacuna
