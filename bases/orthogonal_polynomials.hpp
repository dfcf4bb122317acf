// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/bases/bases.hpp"

namespace lacuna {

/// Polynomials P_0 = 1, P_1 = s, P_(k+1) = a_k s P_k - b_k P_(k-1) of one family.
struct PolynomialFamily {
  StageInfo info;      ///< name, summary and source
  double (*a)(int k);  ///< a_k of the recursion
  double (*b)(int k);  ///< b_k of the recursion
};

inline constexpr PolynomialFamily kChebyshev{
    {"chebyshev", "Products of Chebyshev polynomials of the scaled variables",
     "Abramowitz & Stegun 1964, 22.7.4"},
    [](int k) { return k == 0 ? 1.0 : 2.0; },
    [](int) { return 1.0; }};
inline constexpr PolynomialFamily kLegendre{
    {"legendre", "Products of Legendre polynomials of the scaled variables",
     "Abramowitz & Stegun 1964, 22.7.10"},
    [](int k) { return (2.0 * k + 1.0) / (k + 1.0); },
    [](int k) { return k / (k + 1.0); }};
inline constexpr PolynomialFamily kHermite{
    {"hermite", "Products of Hermite polynomials of the scaled variables",
     "Abramowitz & Stegun 1964, 22.7.14"},
    [](int) { return 1.0; },
    [](int k) { return static_cast<double>(k); }};

/// Options of one family.
template <const PolynomialFamily& Family>
struct PolynomialFamilyOptions {
  static constexpr const StageInfo& kInfo = Family.info;
  OrthogonalPolynomialsOptions products = {};
  void describe(OptionVisitor& v) { products.describe(v); }
};

/// Common part: see chebyshev().
/// @throws ConfigError when high is not above low, or there are more than 100 000 terms.
std::vector<Term> orthogonal_terms(const PolynomialFamily& family,
                                   const OrthogonalPolynomialsOptions& products,
                                   const Variables& variables);

/// What chebyshev(), legendre() and hermite() make.
template <const PolynomialFamily& Family>
class OrthogonalPolynomials final : public Configured<Basis, PolynomialFamilyOptions<Family>> {
 public:
  using Configured<Basis, PolynomialFamilyOptions<Family>>::Configured;

 private:
  std::vector<Term> do_terms(const Variables& variables) const override {
    return orthogonal_terms(Family, this->options().products, variables);
  }
};

}  // namespace lacuna
