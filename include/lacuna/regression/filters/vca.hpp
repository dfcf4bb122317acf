// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/term_filter.hpp"

namespace lacuna {

/// Options of Vca.
struct VcaOptions {
  static constexpr StageInfo kInfo{
      "vca", "Removes what vanishes on the data degree by degree, plain terms first.",
      "R. Livni et al., Proc. 30th Int. Conf. Machine Learning (2013), PMLR 28, 597-605"};

  double tolerance = 1e-8;

  void describe(OptionVisitor& v) {
    v.field({"tolerance", "",
             "Singular values of the unit-norm columns, without their parts in lower degrees, "
             "below this count as zero.",
             0.0, 1.0},
            tolerance);
  }
};

/// Vanishing component analysis over the terms of the library. With F an orthonormal basis of
/// what the terms of lower degrees span, the columns C of unit norm of the next degree give
///
///   C - F F'C = U S V'.
///
/// Combinations with S_i <= tolerance vanish, given lower degrees; the r others join F, and the
/// pivots of V_r' are the terms kept, as in SvdFilter. So what two degrees express alike is
/// removed from the higher one, which a decomposition of all columns at once does not know. The
/// degree of a term is that of its formula in all variables together, a function of them counts
/// as one variable.
class Vca final : public Configured<TermFilter, VcaOptions> {
 public:
  using Configured::Configured;

 private:
  FilterResult do_filter(const LeastSquaresSystem& system,
                         const RunContext& context) const override;
};

}  // namespace lacuna
