// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/diagnose/criterion/criterion.hpp"

namespace lacuna {

/// What extended_bic() makes.
class ExtendedBic final : public Configured<Criterion, ExtendedBicOptions> {
 public:
  using Configured::Configured;

 private:
  double do_penalty(const Evidence& evidence) const override;
};

}  // namespace lacuna
