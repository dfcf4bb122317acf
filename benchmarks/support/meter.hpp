// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <ctime>

namespace lacuna::benchmarks {

/// What a piece of work took.
struct Reading {
  double wall = 0.0;       ///< s
  double cpu = 0.0;        ///< s, of all threads
  double megabytes = 0.0;  ///< most memory above that at the begin
};

/// Measures from its construction on. One at a time.
class Meter {
 public:
  Meter();
  Reading read() const;

 private:
  double before_ = 0.0;
  std::clock_t cpu_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace lacuna::benchmarks
