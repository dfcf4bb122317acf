// SPDX-License-Identifier: MIT
#include "lacuna/pruners/minor_terms.hpp"

#include <cmath>

#include "lacuna/pruners/elimination.hpp"

namespace lacuna {
namespace {

/// The largest acceptable |residual|.
double residual_limit(const MinorTermsOptions& options, const Elimination& full) {
  const double eta = options.effective_eta();
  if (options.tolerances == MinorTermsOptions::Tolerances::Paper)
    return eta * static_cast<double>(full.rows());
  const double floor = options.resolution * (full.target_norm() + full.contributions().sum());
  return (1.0 + eta) * full.residual_norm() + floor;
}

}  // namespace

PruneResult MinorTerms::do_prune(const LeastSquaresSystem& system, Index target,
                                 const TermSet& active, const Regressor& regressor,
                                 const RunContext& context) const {
  const bool by_loss = options().criterion == MinorTermsOptions::Criterion::Residual;
  Elimination state(system, target, active, regressor, context);
  const double limit = residual_limit(options(), state);
  PruneResult result;
  while (state.size() > 0) {
    context.check_stop();
    const Index position = smallest(by_loss ? state.losses() : state.contributions());
    Elimination next = state.without({position});
    if (!(next.residual_norm() <= limit)) break;
    result.removed.push_back({state.active()[static_cast<std::size_t>(position)],
                              "|residual| without the term", next.residual_norm(), limit,
                              static_cast<int>(result.removed.size()) + 1});
    state = std::move(next);
  }
  result.kept = state.active();
  return result;
}

}  // namespace lacuna
