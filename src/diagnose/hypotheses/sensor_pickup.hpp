// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

namespace lacuna {

inline constexpr StageInfo kSensorPickup{
    "sensor-pickup", "A tone that a sensor picks up, in the place of a force", ""};

/// A hum that a sensor picks up moves what is measured and nothing else; a force of its frequency
/// is the next best where no form of a channel is among the candidates. Each tone among the
/// effects of the best composite model is put on each measured channel, coefficients fitted; those
/// of the same frequency in other equations go. It takes its place where the records are
/// explained better beyond doubt.
class SensorPickup final : public Configured<Hypothesis, NoOptions<kSensorPickup>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Revision; }
  int do_order() const override { return 0; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

}  // namespace lacuna
