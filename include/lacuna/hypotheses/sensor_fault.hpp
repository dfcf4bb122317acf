// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/hypotheses/hypothesis.hpp"

namespace lacuna {

inline constexpr StageInfo kSensorFault{
    "sensor-fault", "Effects of the dynamics in the place of a fault that leaves structure",
    ""};

/// A fault of the measurement that leaves structure is not what is wrong, or not all of it:
/// effects of the dynamics take its place where they alone explain most.
class SensorFault final : public Configured<Hypothesis, HypothesisOptions<kSensorFault>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Effects; }
  int do_order() const override { return 1; }
  Proposals do_propose(const Problem& problem, const Account& best) const override;
};

}  // namespace lacuna
