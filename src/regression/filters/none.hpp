// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/filters.hpp"

namespace lacuna {

/// What no_filter() makes.
class NoFilter final : public Configured<TermFilter, NoFilterOptions> {
 public:
  using Configured::Configured;

 private:
  FilterResult do_filter(const LeastSquaresSystem& system,
                         const RunContext& context) const override;
};

}  // namespace lacuna
