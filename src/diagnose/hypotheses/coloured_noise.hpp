// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

namespace lacuna {

inline constexpr StageInfo kColouredNoise{
    "coloured-noise", "The noise of the measurement has a memory",
    "Ornstein-Uhlenbeck process on each channel; Gelb, Applied Optimal Estimation (1974), "
    "Ch. 4.5"};

/// What remains is an error of the measurement that lasts: an Ornstein-Uhlenbeck process on
/// each channel, deviation and correlation time of which are fitted. The fit starts with nearly
/// all of the disagreement in this noise, so that a disturbance of the dynamics has to prove
/// itself beside it. Effects are sought on top.
class ColouredNoiseHypothesis final : public Configured<Hypothesis, NoOptions<kColouredNoise>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Assumptions; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

/// Largest ratio of the noise of a channel, white and with a memory, to what samples show
/// against their neighbours.
/// @param exact the nominal model as given on the records, which knows that.
double noise_inflation(const NoiseModel& noise, const Assimilation& exact);

/// The longest correlation time of noise with a memory worth reporting (`least` as below), in
/// time units; 0 without any.
double longest_memory(const NoiseModel& noise, double least);

/// The channels whose noise has a memory worth reporting (more than `least` of the white
/// part), with its standard deviation and correlation time: "v 0.15 m/s over 4 s".
std::string channels_with_memory(const NoiseModel& noise, const OdeModel& model, double least);

}  // namespace lacuna
