// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/term_pruner.hpp"

namespace lacuna {

/// Options of KeepAll: none.
struct KeepAllOptions {
  static constexpr StageInfo kInfo{"keep-all", "Keeps every term that the filter left.", ""};

  void describe(OptionVisitor&) {}
};

/// Keeps every active term, e.g. where the regressor chooses them itself.
class KeepAll final : public Configured<TermPruner, KeepAllOptions> {
 public:
  using Configured::Configured;

 private:
  PruneResult do_prune(const LeastSquaresSystem& system, Index target, const TermSet& active,
                       const Regressor& regressor, const RunContext& context) const override;
};

}  // namespace lacuna
