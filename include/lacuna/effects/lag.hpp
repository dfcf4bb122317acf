// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/discrepancy/effect.hpp"

namespace lacuna {

inline constexpr StageInfo kLag{
    "lag", "A part of the model acts with finite bandwidth: one more pole", ""};

/// For every term g of the nominal equation g_lagged - g with tau d(g_lagged)/dt = g -
/// g_lagged; the coefficient is that of the term where the whole of it is lagged.
class Lag final : public Configured<Effect, EffectOptions<kLag>> {
 public:
  using Configured::Configured;

 private:
  std::string_view do_typical_cause() const override;
  std::vector<Candidate> do_candidates(const Scope& scope, Index equation) const override;
};

}  // namespace lacuna
