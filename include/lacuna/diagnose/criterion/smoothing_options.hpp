// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"

namespace lacuna {

/// By what records count as smoothed before they were written, and how far that is undone.
struct SmoothingOptions {
  int widest = 41;
  double below = 10.0;
  int turns = 30;
  double in_common = 0.1;
  int least_left = 50;

  void describe(OptionVisitor& visitor);
};

}  // namespace lacuna
