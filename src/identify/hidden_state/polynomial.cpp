// SPDX-License-Identifier: MIT
#include "identify/hidden_state/polynomial.hpp"

#include <cmath>
#include <cstddef>

#include "core/base/check.hpp"

namespace lacuna {

void Polynomial::add(const Exponents& exponents, Estimate coefficient) {
  Estimate& entry = terms_[exponents];
  entry.value += coefficient.value;
  entry.variance += coefficient.variance;
}

namespace {

/// Where the exponent of a variable stands.
std::size_t place_of(const Polynomial& p, Index variable) {
  for (const auto& [exponents, coefficient] : p.terms())
    check_number(variable, static_cast<Index>(exponents.size()), "polynomial", "variable");
  return static_cast<std::size_t>(variable);
}

}  // namespace

Polynomial sum(const Polynomial& a, const Polynomial& b) {
  Polynomial result = a;
  for (const auto& [exponents, coefficient] : b.terms()) result.add(exponents, coefficient);
  return result;
}

Polynomial scaled(const Polynomial& p, double factor) {
  Polynomial result;
  for (const auto& [exponents, coefficient] : p.terms())
    result.add(exponents, {factor * coefficient.value, factor * factor * coefficient.variance});
  return result;
}

Polynomial product(const Polynomial& p, const Polynomial& exact) {
  Polynomial result;
  for (const auto& [exponents, factor] : exact.terms())
    for (const auto& [others, coefficient] : p.terms()) {
      Polynomial::Exponents together = exponents;
      for (std::size_t i = 0; i < together.size(); ++i) together[i] += others[i];
      result.add(together, {factor.value * coefficient.value,
                            factor.value * factor.value * coefficient.variance});
    }
  return result;
}

Polynomial derivative(const Polynomial& p, Index variable) {
  const std::size_t place = place_of(p, variable);
  Polynomial result;
  for (const auto& [exponents, coefficient] : p.terms()) {
    const double power = exponents[place];
    if (exponents[place] == 0) continue;
    Polynomial::Exponents lower = exponents;
    --lower[place];
    result.add(lower, {power * coefficient.value, power * power * coefficient.variance});
  }
  return result;
}

Polynomial substituted(const Polynomial& p, Index variable, const Polynomial& exact) {
  const std::size_t place = place_of(p, variable);
  Polynomial result;
  for (const auto& [exponents, coefficient] : p.terms()) {
    Polynomial::Exponents rest = exponents;
    rest[place] = 0;
    Polynomial term;
    term.add(rest, coefficient);
    for (int power = 0; power < exponents[place]; ++power) term = product(term, exact);
    result = sum(result, term);
  }
  return result;
}

Polynomial evaluated(const Polynomial& p, Index variable, double value) {
  const std::size_t place = place_of(p, variable);
  Polynomial result;
  for (const auto& [exponents, coefficient] : p.terms()) {
    const double factor = std::pow(value, exponents[place]);
    Polynomial::Exponents rest = exponents;
    rest[place] = 0;
    result.add(rest, {factor * coefficient.value, factor * factor * coefficient.variance});
  }
  return result;
}

}  // namespace lacuna
