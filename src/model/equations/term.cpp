// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/term.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/text.hpp"
#include "model/expressions/operations.hpp"

namespace lacuna {
namespace {

using Exponents = std::vector<int>;

/// Beyond it a power is no monomial of any library, and sums of exponents cannot overflow.
constexpr int kLargestExponent = 1000;

std::optional<Exponents> bounded(Exponents exponents) {
  for (const int exponent : exponents)
    if (std::abs(exponent) > kLargestExponent) return std::nullopt;
  return exponents;
}

/// Reads an expression as a product of integer powers of the variables.
class MonomialReader {
 public:
  explicit MonomialReader(const std::vector<std::string>& names) : names_(names) {}

  std::optional<Exponents> read(const Expression& e) const {
    switch (e.operation()) {
      case Operation::Number:
        if (e.value() != 1.0) return std::nullopt;
        return Exponents(names_.size(), 0);
      case Operation::Variable:
        return of_variable(e.name());
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
  std::optional<Exponents> of_variable(const std::string& name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) return std::nullopt;
    Exponents exponents(names_.size(), 0);
    exponents[static_cast<std::size_t>(found - names_.begin())] = 1;
    return exponents;
  }

  std::optional<Exponents> of_product(const Expression& e, int sign) const {
    std::optional<Exponents> first = read(e.operands()[0]);
    if (!first) return std::nullopt;
    const std::optional<Exponents> second = read(e.operands()[1]);
    if (!second) return std::nullopt;
    for (std::size_t i = 0; i < first->size(); ++i) (*first)[i] += sign * (*second)[i];
    return bounded(std::move(*first));
  }

  std::optional<Exponents> of_power(const Expression& e) const {
    const Expression& exponent = e.operands()[1];
    if (exponent.operation() != Operation::Number) return std::nullopt;
    const double power = exponent.value();
    if (power != std::floor(power) || std::abs(power) > kLargestExponent) return std::nullopt;
    std::optional<Exponents> base = read(e.operands()[0]);
    if (!base) return std::nullopt;
    for (int& entry : *base) entry *= static_cast<int>(power);
    return bounded(std::move(*base));
  }

  const std::vector<std::string>& names_;
};

Expression power(const std::string& name, int exponent) {
  const Expression variable = Expression::variable(name);
  if (exponent == 1) return variable;
  return Expression::make(Operation::Power, {variable, Expression::number(exponent)});
}

Expression monomial_expression(const Exponents& exponents,
                               const std::vector<std::string>& names) {
  std::optional<Expression> product;
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    if (exponents[i] == 0) continue;
    const Expression factor = power(names[i], exponents[i]);
    product = product ? *product * factor : factor;
  }
  return product.value_or(Expression::number(1.0));
}

void check_names(const Expression& expression, const std::vector<std::string>& names) {
  for (const std::string& name : expression.variables())
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw ModelError("term '" + expression.to_string() + "'", "unknown name '" + name + "'",
                       suggestion(name, names));
}

}  // namespace

Term::Term(const Expression& expression, const Variables& variables) : expression_(expression) {
  const std::vector<std::string> names = variables.names();
  check_names(expression, names);
  exponents_ = MonomialReader(names).read(expression);
  if (exponents_) expression_ = monomial_expression(*exponents_, names);
  name_ = expression_.to_string();
}

Term Term::parse(std::string_view text, const Variables& variables) {
  return Term(parse_expression(text, variables.names()), variables);
}

Term Term::monomial(const std::vector<int>& exponents, const Variables& variables) {
  if (static_cast<Index>(exponents.size()) != variables.count())
    throw ArgumentError("Term::monomial",
                        std::to_string(exponents.size()) + " exponents for " +
                            std::to_string(variables.count()) + " variables",
                        "give one exponent per variable, time last");
  return Term(monomial_expression(exponents, variables.names()), variables);
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
