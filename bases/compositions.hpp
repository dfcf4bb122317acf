// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/bases/bases.hpp"

namespace lacuna {

/// What sum_of_bases() makes.
class SumOfBases final : public Configured<Basis, SumOfBasesOptions> {
 public:
  using Configured::Configured;

 private:
  std::vector<Term> do_terms(const Variables& variables) const override;
};

/// What product_of_bases() makes.
class ProductOfBases final : public Configured<Basis, ProductOfBasesOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ConfigError for more than 100 000 products.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
