// SPDX-License-Identifier: MIT
#include "bases/orthogonal_polynomials.hpp"

#include <functional>
#include <string>

#include "bases/axis.hpp"
#include "core/base/text.hpp"

namespace lacuna {
namespace {

/// Coefficients of the powers of s in P_0 .. P_degree.
std::vector<Vector> polynomials_of(const PolynomialFamily& family, int degree) {
  std::vector<Vector> all{Vector::Unit(degree + 1, 0)};
  Vector before = Vector::Zero(degree + 1);
  for (int k = 0; k < degree; ++k) {
    Vector next = Vector::Zero(degree + 1);
    next.tail(degree) = family.a(k) * all.back().head(degree);
    next -= (k == 0 ? 0.0 : family.b(k)) * before;
    before = all.back();
    all.push_back(std::move(next));
  }
  return all;
}

/// The polynomial in Horner's order, highest power first: "2*x^2-1".
std::string polynomial_text(const Vector& coefficients, const std::string& s) {
  std::string text;
  for (Index p = coefficients.size() - 1; p >= 0; --p) {
    const double c = coefficients[p];
    if (c == 0.0) continue;
    if (c < 0.0 || !text.empty()) text += c < 0.0 ? "-" : "+";
    const std::string factor = format_number(std::abs(c));
    const std::string power = p == 0 ? "" : p == 1 ? s : s + "^" + std::to_string(p);
    text += power.empty() ? factor : factor == "1" ? power : factor + "*" + power;
  }
  return text;
}

}  // namespace

std::vector<Term> orthogonal_terms(const PolynomialFamily& family,
                                   const OrthogonalPolynomialsOptions& products,
                                   const Variables& variables) {
  const std::string where(family.info.name);
  check_range_of_axis(where, products.low, products.high);
  const std::vector<std::string> names = axis_names(variables, products.with_inputs);
  const std::vector<Vector> polynomials = polynomials_of(family, products.max_degree);
  std::vector<Term> terms;
  const std::function<void(std::size_t, int, const std::string&)> add =
      [&](std::size_t first, int left, const std::string& product) {
        if (left == 0) {
          terms.push_back(Term::parse(product.empty() ? "1" : product, variables));
          check_number_of_terms(where, terms.size());
          return;
        }
        if (first == names.size()) return;
        for (int k = left; k >= 0; --k) {
          if (k == 0) {
            add(first + 1, left, product);
            continue;
          }
          const std::string s = scaled_axis(names[first], products.low, products.high);
          const std::string factor =
              "(" + polynomial_text(polynomials[static_cast<std::size_t>(k)], s) + ")";
          add(first + 1, left - k, product.empty() ? factor : product + "*" + factor);
        }
      };
  for (int degree = 0; degree <= products.max_degree; ++degree) add(0, degree, "");
  return terms;
}

Stage<Basis> chebyshev(const OrthogonalPolynomialsOptions& options) {
  return OrthogonalPolynomials<kChebyshev>({options});
}

Stage<Basis> legendre(const OrthogonalPolynomialsOptions& options) {
  return OrthogonalPolynomials<kLegendre>({options});
}

Stage<Basis> hermite(const OrthogonalPolynomialsOptions& options) {
  return OrthogonalPolynomials<kHermite>({options});
}

}  // namespace lacuna
