// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/filters.hpp"

namespace lacuna {

/// What abm() makes.
class Abm final : public Configured<TermFilter, AbmOptions> {
 public:
  using Configured::Configured;

 private:
  FilterResult do_filter(const LeastSquaresSystem& system,
                         const RunContext& context) const override;
};

}  // namespace lacuna
