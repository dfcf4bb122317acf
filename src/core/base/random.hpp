// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>

namespace lacuna {

/// Seeded source of random numbers; the same seed gives the same numbers on every platform
/// (the distributions of `<random>` are not specified to the bit).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1).
  double uniform();

  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Uniform integer in [0, count); `count` at least 1.
  std::uint64_t below(std::uint64_t count);

  /// Standard normal (mean 0, variance 1) by the Box-Muller transform.
  double normal();

 private:
  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace lacuna
