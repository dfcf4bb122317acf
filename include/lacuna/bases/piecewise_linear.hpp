// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {

/// Options of PiecewiseLinear.
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

/// For every variable v after 1 and the variables themselves: max(v - c_i, 0) for `count` bends c_i
/// from low to high. They span all functions that are linear between the bends; squares and
/// cubes of hinges would be B-splines of higher degree.
class PiecewiseLinear final : public Configured<Basis, PiecewiseLinearOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ConfigError when high is not above low.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
