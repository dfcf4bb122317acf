// SPDX-License-Identifier: MIT
#include "regression/pruners/keep_all.hpp"

namespace lacuna {

PruneResult KeepAll::do_prune(const LeastSquaresSystem&, Index, const TermSet& active,
                              const Regressor&, const RunContext&) const {
  return {active, {}};
}

Stage<TermPruner> keep_all(const KeepAllOptions& options) { return KeepAll(options); }

}  // namespace lacuna
