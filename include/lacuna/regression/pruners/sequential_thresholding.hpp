// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/term_pruner.hpp"

namespace lacuna {

/// Options of SequentialThresholding.
struct SequentialThresholdingOptions {
  static constexpr StageInfo kInfo{"sequential-thresholding",
                                   "Drops all small terms, refits, and repeats until none is.",
                                   "Brunton, Proctor & Kutz, PNAS 113 (2016) 3932"};

  double threshold = 0.01;

  void describe(OptionVisitor& v) {
    v.field({"threshold", "", "Terms with |h_i theta_i| / |y| below this are dropped.", 0.0},
            threshold);
  }
};

/// Drops every term with |h_i theta_i| < threshold |y|, refits with the pipeline's regressor,
/// and repeats until no term is that small. Independent of n, of units and of time scale.
class SequentialThresholding final
    : public Configured<TermPruner, SequentialThresholdingOptions> {
 public:
  using Configured::Configured;

 private:
  PruneResult do_prune(const LeastSquaresSystem& system, Index target, const TermSet& active,
                       const Regressor& regressor, const RunContext& context) const override;
};

}  // namespace lacuna
