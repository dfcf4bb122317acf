// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"

namespace lacuna {

/// Where the verdicts of a validation part, and what is held out for it. What half and double
/// of each changes is in docs/decisions.md.
struct ValidationOptions {
  static constexpr StageInfo kInfo{
      "validation", "What is held out of a record, and which errors are noise", ""};

  double noise_slack = 0.1;
  double scatter = 4.0;
  double structure = 2.0;
  double resolution = 2e-4;
  double small_fraction = 0.01;
  double wrong_fraction = 0.2;
  int least_freedom = 30;

  int held_every = 4;
  int blocks = 20;
  int fewest_blocks = 8;
  int most_samples = 6000;
  int least_windows = 10;
  int noise_samples = 100;
  int correlated_samples = 10;

  void describe(OptionVisitor& v);
};

}  // namespace lacuna
