// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "diagnose/search/rank.hpp"
#include "effect_size.hpp"

namespace lacuna {

/// Coefficient over its standard error; infinite where it has none.
double ratio_to_error(const FittedEffect& effect);

/// Why a candidate does not come in behind what is there; nothing where it may. The gain has to be
/// the effect's own: with a coefficient that is not distinguished from 0 it is that of effects
/// before it, whose shapes have moved. It must not need what contradicts the nominal model
/// (losses that become gains, coefficients far outside of their tolerances), nor terms that
/// nearly cancel or coefficients out of scale where effects are there already.
std::optional<Shortfall> shortfall(const EffectSearch& search, const EffectSize& size,
                                   Extended& before, const RankedEffect& ranked);

}  // namespace lacuna
