// SPDX-License-Identifier: MIT
#include <string>
#include <utility>

#include "lacuna/regression/stages/solvers.hpp"
#include "term_set.hpp"

namespace lacuna {
namespace {

/// Takes out what a hook kept although it is zero on every row.
FilterResult without_zero_columns(FilterResult result, const Vector& norms) {
  TermSet kept;
  for (const Index term : result.kept) {
    if (norms[term] > 0.0)
      kept.push_back(term);
    else
      result.removed.push_back({term, "norm of the column", 0.0, 0.0, 1});
  }
  result.kept = std::move(kept);
  return result;
}

}  // namespace

FilterResult TermFilter::filter(const LeastSquaresSystem& system,
                                const RunContext& context) const {
  context.check_stop();
  FilterResult result = do_filter(system, context);
  check_partition("filter." + std::string(info().name), system.all_terms(), result.kept,
                  result.removed);
  return without_zero_columns(std::move(result), system.factor().column_norms);
}

}  // namespace lacuna
