// SPDX-License-Identifier: MIT
#include "progress_line.hpp"

#include <cmath>

namespace lacuna::cli {

std::string how_far(const std::string& activity, double fraction) {
  const int percent = static_cast<int>(100.0 * fraction);
  return percent > 0 ? activity + ": " + std::to_string(percent) + " %" : activity;
}

std::string ProgressLine::text(const Progress& progress, Time now) {
  constexpr double kMoment = 2.0;  // s; for people: what is shorter is over before it is read
  if (progress.activity != activity_ || progress.fraction < begin_fraction_) {
    activity_ = progress.activity;
    begin_ = now;
    begin_fraction_ = progress.fraction;
  }
  std::string text = how_far(activity_, progress.fraction);
  const std::chrono::duration<double> passed = now - begin_;
  const double done = progress.fraction - begin_fraction_;
  if (passed.count() < kMoment || !(done > 0.0)) return text;
  const double left = passed.count() * (1.0 - progress.fraction) / done;
  return text + ", " + std::to_string(std::lround(left)) + " s left";
}

}  // namespace lacuna::cli
