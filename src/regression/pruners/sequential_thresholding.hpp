// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/pruners.hpp"

namespace lacuna {

/// What sequential_thresholding() makes.
class SequentialThresholding final
    : public Configured<TermPruner, SequentialThresholdingOptions> {
 public:
  using Configured::Configured;

 private:
  PruneResult do_prune(const LeastSquaresSystem& system, Index target, const TermSet& active,
                       const Regressor& regressor, const RunContext& context) const override;
};

}  // namespace lacuna
