// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/diagnose/criterion/options.hpp"

namespace lacuna {

/// What records that chose nothing say of the effects that were named on others.
enum class HoldoutVerdict {
  Confirmed,  ///< most of the gap that could go goes, or there is hardly one
  Little,     ///< less goes: the names hold for the records that were used at best
  Refuted,    ///< the model is worse with the effects than without
};

/// Root mean square gaps on records that were not used.
struct HoldoutGaps {
  double before = 0.0;       ///< nominal model
  double after = 0.0;        ///< with the effects
  double noise_floor = 0.0;  ///< what the measurement noise alone would leave
};

/// The effects are refuted when the gap grows by more than a negligible share; they do little
/// where it does not shrink at all, or where the nominal gap stands above the floor by more
/// than a minor fraction and less than a major fraction of its square, above the floor's, goes.
HoldoutVerdict holdout_verdict(const HoldoutGaps& gaps, const DecisionOptions& decision);

}  // namespace lacuna
