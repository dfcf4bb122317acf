// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/filters.hpp"

namespace lacuna {

/// What vca() makes.
class Vca final : public Configured<TermFilter, VcaOptions> {
 public:
  using Configured::Configured;

 private:
  FilterResult do_filter(const LeastSquaresSystem& system,
                         const RunContext& context) const override;
};

}  // namespace lacuna
