// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/identify/pipeline/result.hpp"

namespace lacuna {

/// How dead times of inputs are sought.
struct DeadTimeOptions {
  static constexpr StageInfo kInfo{"dead-time", "How dead times of inputs are sought", ""};

  double longest = 0.05;

  /// Inputs whose dead time is known; the time 0 of one that acts at once.
  std::vector<DeadTime> given = {};

  void describe(OptionVisitor& v);
};

}  // namespace lacuna
