// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/discrepancy/effect.hpp"

namespace lacuna {

inline constexpr StageInfo kConstantOffset{
    "constant-offset", "A constant is added to the rate of change of a state", ""};

/// The term 1 in an equation that has no constant.
class ConstantOffset final : public Configured<Effect, EffectOptions<kConstantOffset>> {
 public:
  using Configured::Configured;

 private:
  std::string_view do_typical_cause() const override;
  std::vector<Candidate> do_candidates(const Scope& scope, Index equation) const override;
};

}  // namespace lacuna
