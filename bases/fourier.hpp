// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/bases/bases.hpp"

namespace lacuna {

/// What fourier() makes.
class Fourier final : public Configured<Basis, FourierOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ConfigError when the wave number is 0.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
