// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/diagnose/criterion/criterion.hpp"

namespace lacuna {

struct ExtendedBicOptions {
  static constexpr StageInfo kInfo{
      "extended-bic",
      "Bayesian information criterion with a penalty for choosing the best of many",
      "Schwarz, Ann. Statist. 6 (1978); Chen and Chen, Biometrika 95 (2008)"};
  double choice = 1.0;  ///< gamma of Chen and Chen; 0: the plain criterion
  void describe(OptionVisitor& v);
};

/// deviance + parameters log n + 2 gamma sum log(tried): Chen and Chen (2008), eq. (1), with
/// the number of candidates that each chosen effect was the best of.
class ExtendedBic final : public Configured<Criterion, ExtendedBicOptions> {
 public:
  using Configured::Configured;

 private:
  double do_penalty(const Evidence& evidence) const override;
};

}  // namespace lacuna
