// SPDX-License-Identifier: MIT
#include "effects/families.hpp"

namespace lacuna {
namespace {

template <const EffectFamily&... Families>
std::vector<Stage<Effect>> effects_of(FamilyList<Families...>) {
  return {FamilyEffect<Families>()...};
}

}  // namespace

std::vector<Stage<Effect>> standard_effects() { return effects_of(StandardFamilies{}); }

}  // namespace lacuna
