// SPDX-License-Identifier: MIT
#include "linear_terms.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "model/expressions/operations.hpp"
#include "summand_list.hpp"

namespace lacuna {
namespace {

// A fact of cost: sums that are multiplied out grow as a product.
constexpr std::size_t kMostTerms = 1000;

/// coefficient x factors / divisors.
struct Product {
  double coefficient = 1.0;
  std::vector<Expression> factors = {}, divisors = {};
  bool numbered = false;  ///< a number is written in it, which may be 1
};

using Sum = std::vector<Product>;

Sum scaled(Sum sum, double factor) {
  for (Product& product : sum) product.coefficient *= factor;
  return sum;
}

Sum joined(Sum a, Sum b) {
  a.insert(a.end(), std::make_move_iterator(b.begin()), std::make_move_iterator(b.end()));
  return a;
}

void append(std::vector<Expression>& to, const std::vector<Expression>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

Sum multiplied(const Sum& a, const Sum& b) {
  if (a.size() * b.size() > kMostTerms)
    throw ModelError("a product of sums", "it has more than 1000 terms when multiplied out",
                     "write the terms that are meant");
  Sum result;
  for (const Product& left : a)
    for (const Product& right : b) {
      Product product = left;
      product.coefficient *= right.coefficient;
      product.numbered = product.numbered || right.numbered;
      append(product.factors, right.factors);
      append(product.divisors, right.divisors);
      result.push_back(std::move(product));
    }
  return result;
}

bool is_sum(const Expression& e) {
  return e.operation() == Operation::Add || e.operation() == Operation::Subtract;
}

/// (a+b)^1, which says that the sum is to stay together.
bool is_whole(const Expression& e) {
  return e.operation() == Operation::Power && is_sum(e.operands()[0]) &&
         e.operands()[1] == Expression::number(1.0);
}

/// What becomes of sums in products.
enum class Sums { MultipliedOut, Kept };

Sum expanded(const Expression& e, Sums sums);

/// One over an expression; a sum stays a divisor as a whole.
Product reciprocal(const Expression& divisor, Sums sums) {
  const Sum below = expanded(divisor, sums);
  if (below.size() != 1) return {1.0, {}, {divisor}};
  return {1.0 / below[0].coefficient, below[0].divisors, below[0].factors, below[0].numbered};
}

Sum expanded(const Expression& e, Sums sums) {
  if (const auto value = constant_value(e)) return {{.coefficient = *value, .numbered = true}};
  const auto operand = [&](std::size_t i) { return e.operands()[i]; };
  switch (e.operation()) {
    case Operation::Add:
      if (sums == Sums::Kept) return {{1.0, {e}}};
      return joined(expanded(operand(0), sums), expanded(operand(1), sums));
    case Operation::Subtract:
      if (sums == Sums::Kept) return {{1.0, {e}}};
      return joined(expanded(operand(0), sums), scaled(expanded(operand(1), sums), -1.0));
    case Operation::Negate:
      return scaled(expanded(operand(0), sums), -1.0);
    case Operation::Multiply:
      return multiplied(expanded(operand(0), sums), expanded(operand(1), sums));
    case Operation::Divide:
      return multiplied(expanded(operand(0), sums), {reciprocal(operand(1), sums)});
    case Operation::Power:
      if (is_whole(e)) return {{1.0, {operand(0)}}};
      return {{1.0, {e}}};
    default:
      return {{1.0, {e}}};
  }
}

/// The products of a summand. Brackets with nothing but a sign in front are none.
Sum products_of(const Expression& summand, const std::set<std::string>& parameters) {
  const auto of_operand = [&](std::size_t i) {
    return products_of(summand.operands()[i], parameters);
  };
  switch (summand.operation()) {
    case Operation::Add:
      return joined(of_operand(0), of_operand(1));
    case Operation::Subtract:
      return joined(of_operand(0), scaled(of_operand(1), -1.0));
    case Operation::Negate:
      return scaled(of_operand(0), -1.0);
    default:
      return expanded(summand,
                      has_any(summand, parameters) ? Sums::Kept : Sums::MultipliedOut);
  }
}

/// The product of factors; 1 of none.
Expression product_of(const std::vector<Expression>& factors) {
  if (factors.empty()) return Expression::number(1.0);
  Expression product = factors.front();
  for (std::size_t i = 1; i < factors.size(); ++i) product = product * factors[i];
  return product;
}

Term term_of(const Product& product, const VariableIndex& variables) {
  const Expression above = product_of(product.factors);
  return Term(product.divisors.empty() ? above : above / product_of(product.divisors),
              variables);
}

}  // namespace

Equation linear_terms(std::span<const Expression> summands, const VariableIndex& variables,
                      const std::set<std::string>& parameters) {
  SummandList list;
  for (const Expression& summand : summands)
    for (const Product& product : products_of(summand, parameters))
      list.add({.term = term_of(product, variables),
                .coefficient = product.coefficient,
                .fixed = !product.numbered});
  Equation equation = list.take();
  for (const WeightedTerm& summand : equation)
    if (!std::isfinite(summand.coefficient))
      throw ModelError("the coefficient of " + summand.term.name(), "it is not finite",
                       "look for a division by 0");
  std::erase_if(equation, [](const auto& summand) { return summand.coefficient == 0.0; });
  return equation;
}

Equation multiplied_out(const WeightedTerm& summand, const VariableIndex& variables) {
  Equation parts = linear_terms({&summand.term.expression(), 1}, variables);
  for (WeightedTerm& part : parts) {
    part.coefficient *= summand.coefficient;
    part.fixed = part.fixed && summand.fixed;
  }
  return parts;
}

Expression kept_together(const Expression& term, const std::set<std::string>& parameters,
                         bool bare) {
  const bool stays = has_any(term, parameters);
  if (is_sum(term))
    return stays && !bare ? term
                          : Expression::make(Operation::Power, {term, Expression::number(1.0)});
  const bool is_product = term.operation() == Operation::Multiply ||
                          term.operation() == Operation::Divide ||
                          term.operation() == Operation::Negate;
  if (!is_product || (stays && term.operation() != Operation::Negate)) return term;
  std::vector<Expression> operands;
  for (const Expression& operand : term.operands())
    operands.push_back(kept_together(operand, parameters, bare));
  return Expression::make(term.operation(), std::move(operands));
}

}  // namespace lacuna
