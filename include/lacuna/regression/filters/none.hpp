// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/term_filter.hpp"

namespace lacuna {

/// Options of NoFilter: none.
struct NoFilterOptions {
  static constexpr StageInfo kInfo{"none", "Keeps every term except columns of zeros.", ""};

  void describe(OptionVisitor&) {}
};

/// Keeps every term whose column has a norm above 0; nothing else can have a coefficient.
class NoFilter final : public Configured<TermFilter, NoFilterOptions> {
 public:
  using Configured::Configured;

 private:
  FilterResult do_filter(const LeastSquaresSystem& system,
                         const RunContext& context) const override;
};

}  // namespace lacuna
