// SPDX-License-Identifier: MIT
#include "bases/compositions.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "bases/axis.hpp"
#include "model/expressions/total_degree.hpp"

namespace lacuna {
namespace {

bool is_constant(const Term& term) { return term.name() == "1"; }

Term product_of(const Term& a, const Term& b, const Variables& variables) {
  if (is_constant(a)) return b;
  if (is_constant(b)) return a;
  const bool a_is_function = !a.exponents(), b_is_function = !b.exponents();
  const bool swap = a_is_function && (!b_is_function || b.name() < a.name());
  const auto& [front, back] = swap ? std::tie(b, a) : std::tie(a, b);
  return Term(front.expression() * back.expression(), variables);
}

}  // namespace

std::vector<Term> SumOfBases::do_terms(const Variables& variables) const {
  std::vector<Term> terms = options().first->library(variables).terms;
  std::vector<Term> others = options().second->library(variables).terms;
  std::move(others.begin(), others.end(), std::back_inserter(terms));
  return terms;
}

std::vector<Term> ProductOfBases::do_terms(const Variables& variables) const {
  const std::vector<Term> first = options().first->library(variables).terms;
  const std::vector<Term> second = options().second->library(variables).terms;
  check_number_of_terms("product", first.size() * second.size());
  std::vector<std::pair<int, Term>> products;
  for (const Term& a : first)
    for (const Term& b : second) {
      Term product = product_of(a, b, variables);
      const int degree = total_degree(product.expression());
      if (!options().max_degree || degree <= *options().max_degree)
        products.emplace_back(degree, std::move(product));
    }
  std::stable_sort(products.begin(), products.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Term> terms;
  for (auto& [degree, product] : products) terms.push_back(std::move(product));
  return terms;
}

Stage<Basis> sum_of_bases(const SumOfBasesOptions& options) { return SumOfBases(options); }

Stage<Basis> product_of_bases(const ProductOfBasesOptions& options) {
  return ProductOfBases(options);
}

}  // namespace lacuna
