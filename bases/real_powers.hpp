// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/bases/bases.hpp"

namespace lacuna {

/// What real_powers() makes.
class RealPowers final : public Configured<Basis, RealPowersOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ConfigError for an exponent that is no number, 0 or 1.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
