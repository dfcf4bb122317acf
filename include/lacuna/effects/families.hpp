// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/effects/effect_family.hpp"

// The named effects of lacuna; each is one source file on the shelf effects/.
namespace lacuna {

// Terms that a polynomial model lacks.
extern const EffectFamily kConstantOffset, kLinearTerm, kQuadraticTerm, kCubicTerm,
    kHigherOrderTerm, kCrossTerm;

// Couplings.
extern const EffectFamily kFeedthrough, kMissingCoupling, kLeakage;

// Springs, friction, transmissions.
extern const EffectFamily kCubicStiffness, kQuadraticDrag, kCoulombFriction, kStribeckFriction,
    kBacklash, kHysteresis;

// Bends and limits.
extern const EffectFamily kDeadZone, kSaturation, kOneSidedStop, kPiecewiseLinear, kOverflow,
    kSaturatingRate, kExponentialConduction;

// Time and memory.
extern const EffectFamily kPeriodicForcing, kParameterDrift, kTimeTrend, kDelay, kLag,
    kUnmeasuredInput;

// Recording.
extern const EffectFamily kChannelSkew;

}  // namespace lacuna
