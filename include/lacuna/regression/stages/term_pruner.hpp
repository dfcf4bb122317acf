// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/stage.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/stages/regressor.hpp"

namespace lacuna {

/// What a pruner leaves.
struct PruneResult {
  TermSet kept;
  std::vector<Removal> removed;  ///< in the order of removal
};

/// Plug point: chooses the terms of one equation, refitting with the given regressor.
class TermPruner : public StageInterface {
 public:
  static constexpr std::string_view kKind = "pruner";

  /// Chooses among terms of one equation.
  /// @param active increasing numbers of the terms to choose from, below L: what a filter left.
  /// @return kept and removed terms; together they are `active`.
  PruneResult prune(const LeastSquaresSystem& system, Index target, const TermSet& active,
                    const Regressor& regressor, const RunContext& context = {}) const;

 private:
  virtual PruneResult do_prune(const LeastSquaresSystem& system, Index target,
                               const TermSet& active, const Regressor& regressor,
                               const RunContext& context) const = 0;
};

}  // namespace lacuna
