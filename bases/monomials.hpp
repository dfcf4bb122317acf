// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/bases/bases.hpp"

namespace lacuna {

/// What monomials() makes.
class Monomials final : public Configured<Basis, MonomialsOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ConfigError when p_min > p_max or when there are more than 100 000 terms;
  ///   ModelError naming an entry of include or exclude that cannot be read.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
