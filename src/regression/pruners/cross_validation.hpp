// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/pruners.hpp"

namespace lacuna {

/// What cross_validation() makes.
class CrossValidation final : public Configured<TermPruner, CrossValidationOptions> {
 public:
  using Configured::Configured;

 private:
  PruneResult do_prune(const LeastSquaresSystem& system, Index target, const TermSet& active,
                       const Regressor& regressor, const RunContext& context) const override;
};

}  // namespace lacuna
