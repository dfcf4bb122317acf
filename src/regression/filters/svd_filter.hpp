// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/filters.hpp"

namespace lacuna {

/// What svd_filter() makes.
class SvdFilter final : public Configured<TermFilter, SvdFilterOptions> {
 public:
  using Configured::Configured;

 private:
  FilterResult do_filter(const LeastSquaresSystem& system,
                         const RunContext& context) const override;
};

}  // namespace lacuna
