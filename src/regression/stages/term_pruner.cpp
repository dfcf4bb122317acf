// SPDX-License-Identifier: MIT
#include <string>

#include "lacuna/regression/stages/solvers.hpp"
#include "term_set.hpp"

namespace lacuna {

PruneResult TermPruner::prune(const LeastSquaresSystem& system, Index target,
                              const TermSet& active, const Regressor& regressor,
                              const RunContext& context) const {
  context.check_stop();
  const std::string where = "pruner." + std::string(info().name);
  check_term_set(where, active, system.terms());
  if (target < 0 || target >= system.targets())
    throw ArgumentError(where, "there is no target number " + std::to_string(target),
                        "targets are 0 to " + std::to_string(system.targets() - 1));
  if (active.empty()) return {};
  PruneResult result = do_prune(system, target, active, regressor, context);
  check_partition(where, active, result.kept, result.removed);
  return result;
}

}  // namespace lacuna
