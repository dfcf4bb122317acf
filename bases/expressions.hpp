// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/bases/bases.hpp"

namespace lacuna {

/// What expressions() makes.
class Expressions final : public Configured<Basis, ExpressionsOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ModelError naming the entry and the column that cannot be read.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
