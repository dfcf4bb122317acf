// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/effects/effects.hpp"

// The named effects of lacuna; each is one source file on the shelf effects/.
namespace lacuna {

// Terms that a polynomial model lacks.
extern const EffectFamily kConstantOffset, kLinearTerm, kQuadraticTerm, kCubicTerm,
    kHigherOrderTerm, kCrossTerm;

// Couplings.
extern const EffectFamily kFeedthrough, kMissingCoupling, kLeakage;

// Springs, friction, transmissions.
extern const EffectFamily kCubicStiffness, kQuadraticDrag, kCoulombFriction, kStribeckFriction,
    kLoadFriction, kBacklash, kHysteresis, kPeriodicFunction;

// Bends and limits.
extern const EffectFamily kDeadZone, kSaturation, kOneSidedStop, kPiecewiseLinear, kOverflow,
    kSaturatingRate, kExponentialConduction, kExponentialRate, kRateInhibition, kRadiation;

// Time and memory.
extern const EffectFamily kPeriodicForcing, kPeriodicParameter, kParameterDrift, kChange,
    kTimeTrend, kDelay, kLag, kInputLag, kExtraState, kUnmeasuredInput;

// Recording.
extern const EffectFamily kChannelSkew;

/// Families as a type, for what is made of each of them.
template <const EffectFamily&... Families>
struct FamilyList {};

/// All of them, in the order in which they are listed and tried.
using StandardFamilies =
    FamilyList<kConstantOffset, kLinearTerm, kQuadraticTerm, kCubicTerm, kHigherOrderTerm,
               kCrossTerm, kFeedthrough, kMissingCoupling, kLeakage, kCubicStiffness,
               kQuadraticDrag, kCoulombFriction, kStribeckFriction, kLoadFriction, kBacklash,
               kHysteresis, kPeriodicFunction, kDeadZone, kSaturation, kOneSidedStop,
               kPiecewiseLinear, kOverflow, kSaturatingRate, kExponentialConduction,
               kExponentialRate, kRateInhibition, kRadiation, kPeriodicForcing,
               kPeriodicParameter, kParameterDrift, kChange, kTimeTrend, kDelay, kLag,
               kInputLag, kExtraState, kUnmeasuredInput, kChannelSkew>;

}  // namespace lacuna
