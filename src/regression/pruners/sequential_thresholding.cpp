// SPDX-License-Identifier: MIT
#include "regression/pruners/sequential_thresholding.hpp"

#include "regression/pruners/elimination.hpp"

namespace lacuna {
namespace {

/// Positions of the terms below the limit; a term without contribution is always one of them.
std::vector<Index> below(const Vector& contributions, double limit) {
  std::vector<Index> positions;
  for (Index i = 0; i < contributions.size(); ++i)
    if (contributions[i] < limit || contributions[i] == 0.0) positions.push_back(i);
  return positions;
}

}  // namespace

PruneResult SequentialThresholding::do_prune(const LeastSquaresSystem& system, Index target,
                                             const TermSet& active, const Regressor& regressor,
                                             const RunContext& context) const {
  const double threshold = options().threshold;
  PruneResult result;
  Elimination state(system, target, active, regressor, context);
  for (int step = 1;; ++step) {
    context.check_stop();
    const Vector contributions = state.contributions();
    const double scale = state.target_norm();
    const std::vector<Index> small = below(contributions, threshold * scale);
    if (small.empty()) break;
    for (const Index i : small) {
      const double fraction = contributions[i] > 0.0 ? contributions[i] / scale : 0.0;
      result.removed.push_back({state.active()[static_cast<std::size_t>(i)], "|h theta| / |y|",
                                fraction, threshold, step});
    }
    state = state.without(small);
  }
  result.kept = state.active();
  return result;
}

Stage<TermPruner> sequential_thresholding(const SequentialThresholdingOptions& options) {
  return SequentialThresholding(options);
}

}  // namespace lacuna
