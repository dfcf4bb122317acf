// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {

/// Polynomials P_0 = 1, P_1 = s, P_(k+1) = a_k s P_k - b_k P_(k-1) of one family.
struct PolynomialFamily {
  StageInfo info;        ///< name, summary and source
  double (*a)(int k);    ///< a_k of the recursion
  double (*b)(int k);    ///< b_k of the recursion
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

/// Which products there are, and for which range of the variables.
struct PolynomialProducts {
  int max_degree = 3;
  double low = -1.0, high = 1.0;  ///< values of every variable at which s = -1 and 1
  bool with_inputs = true;        ///< inputs are variables too
};

/// Options of OrthogonalPolynomials.
template <const PolynomialFamily& Family>
struct OrthogonalPolynomialsOptions {
  static constexpr const StageInfo& kInfo = Family.info;

  int max_degree = 3;
  double low = -1.0, high = 1.0;
  bool with_inputs = true;

  void describe(OptionVisitor& v) {
    v.field({"max_degree", "", "Highest degree of a product.", 0.0, 12.0}, max_degree);
    v.field({"low", "unit of the variables", "Value of every variable at which s = -1."}, low);
    v.field({"high", "unit of the variables", "Value of every variable at which s = 1."}, high);
    v.field({"with_inputs", "", "Whether inputs are variables too."}, with_inputs);
  }
};

/// Common part: see OrthogonalPolynomials.
/// @throws ConfigError when high is not above low, or there are more than 100 000 terms.
std::vector<Term> orthogonal_terms(const PolynomialFamily& family,
                                   const PolynomialProducts& products,
                                   const Variables& variables);

/// All products prod_j P_(k_j)(s_j), sum_j k_j <= max_degree, of the variables scaled to
/// s = (2 v - low - high) / (high - low), by degree. Where s covers [-1, 1] evenly (for Hermite:
/// has a normal distribution) columns hardly depend on each other. A term is written as the plain
/// polynomial of its variables in brackets, "(2*x^2-1)*y".
template <const PolynomialFamily& Family>
class OrthogonalPolynomials final
    : public Configured<Basis, OrthogonalPolynomialsOptions<Family>> {
 public:
  using Configured<Basis, OrthogonalPolynomialsOptions<Family>>::Configured;

 private:
  std::vector<Term> do_terms(const Variables& variables) const override {
    const auto& o = this->options();
    return orthogonal_terms(Family, {o.max_degree, o.low, o.high, o.with_inputs}, variables);
  }
};

using Chebyshev = OrthogonalPolynomials<kChebyshev>;
using Legendre = OrthogonalPolynomials<kLegendre>;
using Hermite = OrthogonalPolynomials<kHermite>;

}  // namespace lacuna
