// SPDX-License-Identifier: MIT
#include "product_forms.hpp"

#include <algorithm>

#include "lacuna/effects/effects.hpp"
#include "lacuna/model/equations/term.hpp"

namespace lacuna {
namespace {

/// Number of a variable in slot order.
std::size_t slot_of(const Scope& scope, const std::string& name) {
  std::size_t slot = 0;
  while (scope.variables[slot].name != name) ++slot;
  return slot;
}

void add_exponents(const Scope& scope, std::vector<int> exponents, std::size_t from, int left,
                   std::vector<Expression>& result) {
  const Variables variables = scope.model.variables();
  for (std::size_t i = from; i < scope.variables.size() && left > 0; ++i) {
    ++exponents[i];
    result.push_back(Term::monomial(exponents, variables).expression());
    add_exponents(scope, exponents, i, left - 1, result);
    --exponents[i];
  }
}

constexpr const char* kInhibited[] = {"m/(1+x/a)", "m/(1+x^2/a^2)", "m/(1+x^3/a^3)",
                                      "m/(1+x^4/a^4)"};
/// The same for monomials that have the factor x^n.
constexpr const char* kSaturated[] = {"m/(a+x)", "m/(a^2+x^2)", "m/(a^3+x^3)", "m/(a^4+x^4)"};

/// Products with functions of one variable.
class Products {
 public:
  Products(const Scope& scope, const VariableRange& range)
      : scope_(scope),
        range_(range),
        variables_(scope.model.variables()),
        slot_(slot_of(scope, range.name)) {}

  /// @param exponent n, 1 to 4.
  void add(const Expression& monomial, int exponent, std::vector<Candidate>& result) const {
    const auto n = static_cast<std::size_t>(exponent - 1);
    std::vector<int> exponents = *Term(monomial, variables_).exponents();
    // m/(1+x^n/a^n) with a factor x^n in m is the saturated form of another monomial.
    if (exponents[slot_] >= exponent) return;
    push(kInhibited[n], monomial, result);
    exponents[slot_] += exponent;
    push(kSaturated[n], Term::monomial(exponents, variables_).expression(), result);
  }

 private:
  void push(const char* pattern, const Expression& monomial,
            std::vector<Candidate>& result) const {
    // A fact of the search: along the range of the variable.
    constexpr int kStarts = 7;
    const Expression x = Expression::variable(range_.name);
    const double size = range_.magnitude();
    result.push_back(
        shaped_candidate(formula(scope_, pattern, {{"x", x}, {"m", monomial}}), x,
                         {scope_.free_name("a"), range_.unit, 0.02 * size, 20.0 * size, true},
                         geometric_starts(0.06 * size, 3.0 * size, kStarts)));
  }

  const Scope& scope_;
  const VariableRange& range_;
  Variables variables_;
  std::size_t slot_;
};

}  // namespace

std::vector<Expression> monomials_of(const Scope& scope, int degree) {
  std::vector<Expression> result{Expression::number(1.0)};
  const auto count = static_cast<std::size_t>(scope.model.variables().count());
  add_exponents(scope, std::vector<int>(count, 0), 0, degree, result);
  return result;
}

std::vector<Candidate> product_forms(const Scope& scope) {
  std::vector<Candidate> result;
  const std::vector<Expression> monomials = monomials_of(scope, 2);
  for (const VariableRange& range : scope.variables) {
    if (range.is_input || !(range.magnitude() > 0.0)) continue;
    const Products products(scope, range);
    for (int exponent = 1; exponent <= 4; ++exponent) {
      if (exponent % 2 == 1 && !range.is_amount()) continue;
      for (const Expression& monomial : monomials) products.add(monomial, exponent, result);
    }
  }
  return result;
}

}  // namespace lacuna
