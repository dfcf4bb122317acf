// SPDX-License-Identifier: MIT
// Composite models in which sensors do not show what is.
#pragma once

#include <string>
#include <string_view>

#include "lacuna/diagnose/hypotheses/composite_model.hpp"

namespace lacuna {

/// What a composite model calls one of its effects.
const NamedEffect& name_in(const CompositeModel& composite, const FittedEffect& effect);

/// What sensors show in the place of effects of a composite model.
struct SensorFinding {
  std::string_view hypothesis;
  std::string cause;  ///< of what the sensors show
  /// Sensors first, with forms of channel_forms() or late_channel_forms(); then effects of the
  /// composite model before.
  Explanation explanation;
  std::size_t sensors = 0;
  Index tried = 0;
};

/// The composite model of a finding on the baseline of the one before.
CompositeModel composite_with(const Problem& problem, const CompositeModel& before,
                              const SensorFinding& finding);

}  // namespace lacuna
