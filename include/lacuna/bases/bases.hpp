// SPDX-License-Identifier: MIT
// The bases of lacuna. Each function makes one from its options; `Registry` has the same by
// name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {

/// Options of monomials().
struct MonomialsOptions {
  static constexpr StageInfo kInfo{
      "monomials", "Products of powers of the variables, in degree-lexicographic order",
      "Karimov et al., Nonlinear Dyn. 111 (2023), Sect. 2.1: deglexord(p_min, p_max, m)"};

  int min_degree = 0;                     ///< p_min
  int max_degree = 3;                     ///< p_max
  bool with_inputs = true;                ///< inputs are variables too
  bool with_time = false;                 ///< t is one more variable
  std::vector<std::string> include = {};  ///< further terms, behind the monomials
  std::vector<std::string> exclude = {};  ///< terms left out

  void describe(OptionVisitor& v) {
    v.field({"min_degree", "", "Lowest degree p_min; below 0 there are negative powers too.",
             -10.0, 20.0},
            min_degree);
    v.field({"max_degree", "", "Highest degree p_max.", 0.0, 20.0}, max_degree);
    v.field({"with_inputs", "", "Whether inputs are variables of the monomials."}, with_inputs);
    v.field({"with_time", "", "Whether the time t is one more variable."}, with_time);
    v.field({"include", "", "Further terms, tried after the monomials."}, include);
    v.field({"exclude", "", "Terms left out, written in any way: 'y*x' is 'x*y'."}, exclude);
  }
};

/// All monomials tau = prod_j v_j^e_j whose exponents e satisfy
///
///   sum of the positive e_j <= p_max  and, when p_min < 0,  sum of the negative e_j >= p_min;
///   when p_min >= 0, all e_j >= 0 and p_min <= sum of e_j.
///
/// So p_min = -1 adds 1/x, y/x, x^2/y, but not 1/(x*y), which takes p_min = -2. The order is by
/// degree (the sum of all e_j), then by the sum of |e_j|, then lexicographic with the first
/// variable's largest |e_j| first (x before 1/x); up to degree 2 in three variables 1, x, y, z,
/// x^2, x*y, x*z, y^2, y*z, z^2.
Stage<Basis> monomials(const MonomialsOptions& options = {});

/// Options of expressions().
struct ExpressionsOptions {
  static constexpr StageInfo kInfo{"expressions", "The candidate terms that are written out",
                                   ""};

  std::vector<std::string> terms = {};  ///< expressions in states, inputs and t

  void describe(OptionVisitor& v) {
    v.field({"terms", "", "The terms, e.g. sign(v), 1, u, delay(x,0.5)."}, terms);
  }
};

/// The terms that the user writes, in the order given.
Stage<Basis> expressions(const ExpressionsOptions& options = {});

/// Options of fourier().
struct FourierOptions {
  static constexpr StageInfo kInfo{"fourier", "Sines and cosines of multiples of the variables",
                                   ""};

  int harmonics = 2;         ///< highest multiple
  double wave_number = 1.0;  ///< w of the first multiple
  bool with_linear = true;   ///< 1 and the variables themselves come first
  bool with_inputs = false;  ///< inputs are variables too

  void describe(OptionVisitor& v) {
    v.field({"harmonics", "", "Highest multiple K of the wave number.", 1.0, 100.0}, harmonics);
    v.field(
        {"wave_number", "rad per unit of the variable", "Wave number w of the first multiple."},
        wave_number);
    v.field({"with_linear", "", "Whether 1 and the variables themselves are terms."},
            with_linear);
    v.field({"with_inputs", "", "Whether inputs are variables too."}, with_inputs);
  }
};

/// For every variable v: sin(k w v), cos(k w v), k = 1..K, after 1 and the variables
/// themselves.
Stage<Basis> fourier(const FourierOptions& options = {});

/// Options of chebyshev(), legendre() and hermite().
struct OrthogonalPolynomialsOptions {
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

/// All products prod_j T_(k_j)(s_j), sum_j k_j <= max_degree, of the variables scaled to
/// s = (2 v - low - high) / (high - low), by degree, T_k the Chebyshev polynomials (Abramowitz
/// & Stegun 1964, 22.7.4). Where s covers [-1, 1] evenly columns hardly depend on each other. A
/// term is written as the plain polynomial of its variables in brackets, "(2*x^2-1)*y".
/// @throws ConfigError when an option is out of its range.
Stage<Basis> chebyshev(const OrthogonalPolynomialsOptions& options = {});

/// The same with Legendre polynomials (Abramowitz & Stegun 1964, 22.7.10).
Stage<Basis> legendre(const OrthogonalPolynomialsOptions& options = {});

/// The same with Hermite polynomials (Abramowitz & Stegun 1964, 22.7.14), for s of a normal
/// distribution.
Stage<Basis> hermite(const OrthogonalPolynomialsOptions& options = {});

/// Options of radial_functions().
struct RadialFunctionsOptions {
  static constexpr StageInfo kInfo{"radial", "Gaussians around places on each variable",
                                   "Broomhead & Lowe, Complex Systems 2 (1988) 321-355"};

  int count = 5;
  double low = -1.0, high = 1.0;
  bool with_inputs = false;

  void describe(OptionVisitor& v) {
    v.field({"count", "", "Places on each variable, with equal spacing.", 1.0, 1000.0}, count);
    v.field({"low", "unit of the variables", "The first of them."}, low);
    v.field({"high", "unit of the variables", "The last of them."}, high);
    v.field({"with_inputs", "", "Whether inputs are variables too."}, with_inputs);
  }
};

/// For every variable v after 1 and the variables themselves: exp(-((v - c_i) / d)^2 / 2) for
/// `count` centres c_i from low to high and their spacing d (half the range where there is one
/// centre).
Stage<Basis> radial_functions(const RadialFunctionsOptions& options = {});

/// Options of piecewise_linear().
struct PiecewiseLinearOptions {
  static constexpr StageInfo kInfo{"piecewise-linear",
                                   "Hinges max(v - c, 0): piecewise linear functions",
                                   "J. H. Friedman, Ann. Stat. 19 (1991) 1-67, eq. (31)"};

  int count = 5;
  double low = -1.0, high = 1.0;
  bool with_inputs = false;

  void describe(OptionVisitor& v) {
    v.field({"count", "", "Bends on each variable, with equal spacing.", 1.0, 1000.0}, count);
    v.field({"low", "unit of the variables", "The first of them."}, low);
    v.field({"high", "unit of the variables", "The last of them."}, high);
    v.field({"with_inputs", "", "Whether inputs are variables too."}, with_inputs);
  }
};

/// For every variable v after 1 and the variables themselves: max(v - c_i, 0) for `count` bends
/// c_i from low to high. They span all functions that are linear between the bends; squares and
/// cubes of hinges would be B-splines of higher degree.
Stage<Basis> piecewise_linear(const PiecewiseLinearOptions& options = {});

/// Options of real_powers().
struct RealPowersOptions {
  static constexpr StageInfo kInfo{"real-powers", "Powers of each variable with real exponents",
                                   "M. A. Savageau, J. Theor. Biol. 25 (1969) 365-369"};

  std::vector<std::string> exponents = {"0.5", "1.5"};
  bool signed_powers = true;
  bool with_inputs = false;

  void describe(OptionVisitor& v) {
    v.field({"exponents", "", "Exponents p, any numbers but 0 and 1."}, exponents);
    v.field(
        {"signed_powers", "",
         "Whether a power is sign(v)*abs(v)^p, which all v have, instead of v^p, which only "
         "positive ones have."},
        signed_powers);
    v.field({"with_inputs", "", "Whether inputs are variables too."}, with_inputs);
  }
};

/// For every variable v after 1 and the variables themselves: sign(v) |v|^p or v^p.
Stage<Basis> real_powers(const RealPowersOptions& options = {});

/// Options of sum_of_bases(); the bases have no defaults.
struct SumOfBasesOptions {
  static constexpr StageInfo kInfo{"sum", "The terms of two bases", ""};

  Stage<Basis> first;
  Stage<Basis> second;

  void describe(OptionVisitor& v) {
    v.field({"first", "", "The basis whose terms are tried first."}, first);
    v.field({"second", "", "The basis whose terms come behind them."}, second);
  }
};

/// The terms of the first basis, then those of the second that the first has not. More than two
/// are added one by one: the second basis may be a sum.
Stage<Basis> sum_of_bases(const SumOfBasesOptions& options);

/// Options of product_of_bases(); the bases have no defaults.
struct ProductOfBasesOptions {
  static constexpr StageInfo kInfo{"product", "Products of the terms of two bases", ""};

  Stage<Basis> first;
  Stage<Basis> second;
  std::optional<int> max_degree = {};

  void describe(OptionVisitor& v) {
    v.field({"first", "", "The basis of the first factors."}, first);
    v.field({"second", "", "The basis of the second factors."}, second);
    v.field({"max_degree", "",
             "Highest degree of a product, in which a function of variables counts as one; no "
             "bound when not given.",
             0.0, 40.0},
            max_degree);
  }
};

/// All products a * b of terms a of the first and b of the second basis, by degree; those of
/// one degree in the order of a, then of b. Products of two monomials are monomials; of others
/// a monomial stands in front, and two functions stand in the order of their texts, so that
/// sin(x)*cos(x) is there once. Where both bases have 1, all their own terms are among the
/// products.
Stage<Basis> product_of_bases(const ProductOfBasesOptions& options);

}  // namespace lacuna
