// SPDX-License-Identifier: MIT
#include <algorithm>

#include "lacuna/effects/effects.hpp"
#include "lacuna/model/equations/term.hpp"
#include "product_forms.hpp"

namespace lacuna {
namespace {

/// Functions with a length `a`, beside a monomial m.
constexpr const char* kComposedWithLength[] = {"m*exp(x/a)", "m*exp(-x/a)", "m*sin(x/a)",
                                               "m*cos(x/a)"};
/// The same without.
constexpr const char* kComposedPlain[] = {"m*sin(x)", "m*cos(x)"};
/// The same for variables that are positive.
constexpr const char* kComposedOfPositive[] = {"m/x", "m/x^2", "m/x^3"};
/// Of differences d of two variables.
constexpr const char* kComposedOfDifferences[] = {"sin(d)", "cos(d)", "abs(d)", "d*abs(d)"};

/// Compositions of monomials and functions of one variable.
class Compositions {
 public:
  explicit Compositions(const Scope& scope) : scope_(scope) {}

  void add(const Expression& m, const VariableRange& range) {
    const Expression x = Expression::variable(range.name);
    const bool has_factor = m.variables().contains(range.name);
    if (!m.variables().empty()) add_products(m, x, range);
    if (!(range.low > 0.0) || has_factor) return;
    for (const char* pattern : kComposedOfPositive) plain(pattern, m, x);
    if (m.variables().empty()) return;
    // A fact of the search: exponents of laws of growth, of surfaces and of contacts.
    shaped("m*x^power", m, x, {scope_.free_name("power"), "", 0.1, 4.0, true},
           starts_at({0.4, 0.7, 1.5, 2.5}));
  }

  void add(const VariableRange& first, const VariableRange& second) {
    const Expression x = Expression::variable(first.name);
    const Expression y = Expression::variable(second.name);
    for (const char* pattern : kComposedOfDifferences) plain(pattern, x, x - y);
    for (const Expression& m : {x, y})
      result_.push_back(
          plain_candidate(formula(scope_, "m*abs(d)", {{"m", m}, {"d", x - y}}), x - y));
  }

  std::vector<Candidate> take() { return std::move(result_); }

 private:
  void add_products(const Expression& m, const Expression& x, const VariableRange& range) {
    // Facts of the search: from a bend within the range to a polynomial of low degree.
    constexpr int kStarts = 6;
    const double size = range.magnitude();
    for (const char* pattern : kComposedPlain) plain(pattern, m, x);
    for (const char* pattern : kComposedWithLength)
      shaped(pattern, m, x, {scope_.free_name("a"), range.unit, 0.05 * size, 50.0 * size, true},
             geometric_starts(0.15 * size, 12.0 * size, kStarts));
  }

  void plain(const char* pattern, const Expression& m, const Expression& x) {
    result_.push_back(
        plain_candidate(formula(scope_, pattern, {{"m", m}, {"x", x}, {"d", x}}), x));
  }

  void shaped(const char* pattern, const Expression& m, const Expression& x,
              const ShapeParameter& shape, std::vector<Vector> starts) {
    result_.push_back(shaped_candidate(formula(scope_, pattern, {{"m", m}, {"x", x}}), x, shape,
                                       std::move(starts)));
  }

  const Scope& scope_;
  std::vector<Candidate> result_;
};

}  // namespace

std::vector<Candidate> composed_forms(const Scope& scope, Index equation) {
  constexpr std::size_t kVariablesOfProducts = 3;  // of more: the variables themselves
  const int degree = scope.variables.size() <= kVariablesOfProducts ? 2 : 1;
  Compositions compositions(scope);
  const std::vector<Expression> monomials = monomials_of(scope, degree);
  for (std::size_t i = 0; i < scope.variables.size(); ++i) {
    const VariableRange& range = scope.variables[i];
    if (range.is_input || !(range.magnitude() > 0.0)) continue;
    for (const Expression& monomial : monomials) compositions.add(monomial, range);
    for (std::size_t j = 0; j < i; ++j)
      if (!scope.variables[j].is_input) compositions.add(scope.variables[j], range);
  }
  std::vector<Candidate> result = compositions.take();
  for (Candidate& candidate : result) {
    candidate.equation = equation;
    if (candidate.starts.empty()) candidate.starts = {Vector()};
  }
  return result;
}

}  // namespace lacuna
