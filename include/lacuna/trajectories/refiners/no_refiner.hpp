// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/refiner.hpp"

namespace lacuna {

/// NoRefiner has no options.
struct NoRefinerOptions {
  static constexpr StageInfo kInfo{"none", "Leaves the model as the regression gives it", ""};
  void describe(OptionVisitor&) {}
};

/// Leaves the model as it is.
class NoRefiner final : public Configured<Refiner, NoRefinerOptions> {
 public:
  using Configured::Configured;

 private:
  RefinedModel do_refine(const RefinerTask& task, const RunContext& context) const override;
};

}  // namespace lacuna
