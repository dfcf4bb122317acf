// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/discrepancy/effect.hpp"

namespace lacuna {

inline constexpr StageInfo kCoulombFriction{
    "coulomb-friction", "Dry friction: a constant force against the velocity",
    "Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994)"};

/// sign(v) and tanh(v/width) of the states, in their own equations.
class CoulombFriction final : public Configured<Effect, EffectOptions<kCoulombFriction>> {
 public:
  using Configured::Configured;

 private:
  std::string_view do_typical_cause() const override;
  std::vector<Candidate> do_candidates(const Scope& scope, Index equation) const override;
};

}  // namespace lacuna
