// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/pruners.hpp"

namespace lacuna {

/// What information_criterion() makes.
class InformationCriterion final : public Configured<TermPruner, InformationCriterionOptions> {
 public:
  using Configured::Configured;

 private:
  PruneResult do_prune(const LeastSquaresSystem& system, Index target, const TermSet& active,
                       const Regressor& regressor, const RunContext& context) const override;
};

}  // namespace lacuna
