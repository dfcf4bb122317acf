// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/options.hpp"

namespace lacuna {

/// By how much later an input acts than it is recorded.
struct DeadTime {
  std::string input;
  double time = 0.0;  ///< time units of the record
  /// Of the time, where it was found and not given.
  std::optional<double> standard_error = {};
  std::optional<std::array<double, 2>> ci95 = {};
};

/// How dead times of inputs are sought.
struct DeadTimeOptions {
  static constexpr StageInfo kInfo{"dead_time", "How dead times of inputs are sought", ""};

  double longest = 0.05;

  /// Inputs whose dead time is known; the time 0 of one that acts at once.
  std::vector<DeadTime> given = {};

  void describe(OptionVisitor& v);
};

}  // namespace lacuna
