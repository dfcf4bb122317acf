// SPDX-License-Identifier: MIT
#include "regression/filters/none.hpp"

namespace lacuna {

FilterResult NoFilter::do_filter(const LeastSquaresSystem& system, const RunContext&) const {
  FilterResult result;
  const Vector& norms = system.factor().column_norms;
  for (Index j = 0; j < norms.size(); ++j) {
    if (norms[j] > 0.0) {
      result.kept.push_back(j);
    } else {
      result.removed.push_back({j, "norm of the column", 0.0, 0.0, 1});
    }
  }
  return result;
}

Stage<TermFilter> no_filter(const NoFilterOptions& options) { return NoFilter(options); }

}  // namespace lacuna
