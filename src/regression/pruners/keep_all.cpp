// SPDX-License-Identifier: MIT
#include "lacuna/regression/pruners/keep_all.hpp"

namespace lacuna {

PruneResult KeepAll::do_prune(const LeastSquaresSystem&, Index, const TermSet& active,
                              const Regressor&, const RunContext&) const {
  return {active, {}};
}

}  // namespace lacuna
