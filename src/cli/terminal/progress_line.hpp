// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

#include "lacuna/core/base/run_context.hpp"

namespace lacuna::cli {

/// "fitting: 45 %"; without a percentage as long as it is 0: nothing is counted then.
std::string how_far(const std::string& activity, double fraction);

/// What is said of a run's progress: activity, share, and the time that is left of an activity
/// that takes longer than a moment.
class ProgressLine {
 public:
  using Time = std::chrono::steady_clock::time_point;

  std::string text(const Progress& progress, Time now);

 private:
  std::string activity_;
  Time begin_{};
  double begin_fraction_ = 0.0;
};

}  // namespace lacuna::cli
