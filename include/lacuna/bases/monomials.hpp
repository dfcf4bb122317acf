// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {

/// Options of Monomials.
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
class Monomials final : public Configured<Basis, MonomialsOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ConfigError when p_min > p_max or when there are more than 100 000 terms;
  ///   ModelError naming an entry of include or exclude that cannot be read.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
