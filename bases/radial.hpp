// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/bases/bases.hpp"

namespace lacuna {

/// What radial_functions() makes.
class RadialFunctions final : public Configured<Basis, RadialFunctionsOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ConfigError when high is not above low.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
