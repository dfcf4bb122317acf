// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/bases/bases.hpp"

namespace lacuna {

/// What piecewise_linear() makes.
class PiecewiseLinear final : public Configured<Basis, PiecewiseLinearOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ConfigError when high is not above low.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
