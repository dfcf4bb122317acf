// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/term_filter.hpp"

namespace lacuna {

/// Options of SvdFilter.
struct SvdFilterOptions {
  static constexpr StageInfo kInfo{
      "svd", "Keeps as many well-conditioned terms as the candidates have numerical rank.",
      "Golub & Van Loan, Matrix Computations, Sect. 5.5.7 (subset selection)"};

  double tolerance = 1e-8;

  void describe(OptionVisitor& v) {
    v.field({"tolerance", "",
             "Singular values of the unit-norm columns below this fraction of the largest "
             "count as zero.",
             0.0, 1.0},
            tolerance);
  }
};

/// Rank-revealing filter: E (n x L, columns of unit norm) = U S V'. The rank r is the number of
/// singular values above tolerance * S_1. The r terms kept are the pivots of a column-pivoted
/// QR of V_r' (r x L), which bounds how much worse than S_r the kept columns' smallest singular
/// value can be. Of columns that serve alike (at least half of the largest remaining norm) the
/// first in library order is taken, so that simple terms are preferred. Independent of n, of
/// units and of time scale.
class SvdFilter final : public Configured<TermFilter, SvdFilterOptions> {
 public:
  using Configured::Configured;

 private:
  FilterResult do_filter(const LeastSquaresSystem& system,
                         const RunContext& context) const override;
};

}  // namespace lacuna
