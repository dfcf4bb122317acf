// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {

/// Options of SumOfBases; the bases have no defaults.
struct SumOfBasesOptions {
  static constexpr StageInfo kInfo{"sum", "The terms of two bases", ""};

  Stage<Basis> first;
  Stage<Basis> second;

  void describe(OptionVisitor& v) {
    v.field({"first", "", "The basis whose terms are tried first."}, first);
    v.field({"second", "", "The basis whose terms come behind them."}, second);
  }
};

/// The terms of the first basis, then those of the second that the first has not. More than two
/// are added one by one: the second basis may be a sum.
class SumOfBases final : public Configured<Basis, SumOfBasesOptions> {
 public:
  using Configured::Configured;

 private:
  std::vector<Term> do_terms(const Variables& variables) const override;
};

/// Options of ProductOfBases; the bases have no defaults.
struct ProductOfBasesOptions {
  static constexpr StageInfo kInfo{"product", "Products of the terms of two bases", ""};

  Stage<Basis> first;
  Stage<Basis> second;
  std::optional<int> max_degree = {};

  void describe(OptionVisitor& v) {
    v.field({"first", "", "The basis of the first factors."}, first);
    v.field({"second", "", "The basis of the second factors."}, second);
    v.field({"max_degree", "",
             "Highest degree of a product, in which a function of variables counts as one; no "
             "bound when not given.",
             0.0, 40.0},
            max_degree);
  }
};

/// All products a * b of terms a of the first and b of the second basis, by degree; those of one
/// degree in the order of a, then of b. Products of two monomials are monomials; of others a
/// monomial stands in front, and two functions stand in the order of their texts, so that
/// sin(x)*cos(x) is there once. Where both bases have 1, all their own terms are among the
/// products.
class ProductOfBases final : public Configured<Basis, ProductOfBasesOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ConfigError for more than 100 000 products.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
