// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

namespace lacuna {

inline constexpr StageInfo kSensorFault{
    "sensor-fault", "Effects of the dynamics in the place of a fault that leaves structure",
    ""};

/// A fault of the measurement that leaves structure is not what is wrong, or not all of it:
/// effects of the dynamics take its place where they alone explain most.
class SensorFault final : public Configured<Hypothesis, NoOptions<kSensorFault>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Revision; }
  int do_order() const override { return 1; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

inline constexpr StageInfo kSensorCalibration{
    "sensor-calibration",
    "The model holds as it is given, and one channel has a gain, an offset, a drift or a lag",
    ""};

/// The nominal model with its coefficients as given, measured by a channel k that shows
/// x_k + c f: f = x_k (sensor-gain), 1 (sensor-offset), the time since the start
/// (sensor-drift), or the value behind a filter of first order less x_k (sensor-lag).
///
/// It is proposed where such a channel leaves nothing over. On equal terms, with the other
/// coefficients as given, a change of one coefficient and the effects of the best composite
/// model so far must do worse by more than the evidence that cannot distinguish two
/// explanations.
class SensorCalibration final : public Configured<Hypothesis, NoOptions<kSensorCalibration>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Revision; }
  int do_order() const override { return 2; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

inline constexpr StageInfo kSensorTiming{
    "sensor-timing", "Sensors that show their states late, in the place of what acts late", ""};

/// Behind a filter, or made of means or differences of samples, a sensor shows its state late,
/// and no skew, lag or delay of anything else is of that form. Where the best composite model has
/// an effect that says when something acts or is sampled, filters of the channels
/// (late_channel_forms()) are tried in the place of its effects, and beside each of those that
/// are in the dynamics, coefficients fitted.
///
/// They take its place where they do better by more than the evidence that cannot distinguish
/// two explanations. Within that, and where all channels are late by one time, which inputs that
/// act late make as well, the one with fewer parameters leads (the dynamics, if equal), and the
/// other is a doubt: then neither is the explanation.
class SensorTiming final : public Configured<Hypothesis, NoOptions<kSensorTiming>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Revision; }
  int do_order() const override { return 0; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

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

inline constexpr StageInfo kInputSkew{
    "input-skew", "An input is recorded later than the states, by up to four sampling steps",
    ""};

/// What acts is u(t + T), and u(t) is what was recorded: a column that is written one sample
/// late, the mean over the step before, a slower converter. T is the likeliest for the nominal
/// model, coefficients fitted, with nothing or with the first of the effects of the best
/// composite model, then of those that are found with the input moved ahead, until it stays. An
/// input that acts late is no such fault: that is a delay of the plant.
///
/// It is proposed where something is missing and the moved input does better than the best
/// composite model, and not when it is moved the other way: between samples its noise is
/// averaged.
class InputSkew final : public Configured<Hypothesis, NoOptions<kInputSkew>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Assumptions; }
  int do_order() const override {
    return 2;
  }  // noise with a memory needs no fault of the record
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

inline constexpr StageInfo kInputInterpolation{
    "input-interpolation",
    "An input that was recorded seldom, and put on straight lines between, is smooth", ""};

/// Records of several sources are brought to one time, and lines take the place of what was not
/// recorded. The error of the lines goes along with the input and its curvature; effects that
/// are functions of these were named for it. In their place the cubics through the samples that
/// were recorded (interpolated_samples()) are tried; it is proposed as an InputSkew is.
class InputInterpolation final : public Configured<Hypothesis, NoOptions<kInputInterpolation>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Assumptions; }
  int do_order() const override { return 1; }  // a curve can be moved ahead, lines hardly
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

inline constexpr StageInfo kInputSmoothing{
    "input-smoothing", "The noise with which an input was measured does not act", ""};

/// An input whose samples show white noise (noise_of_inputs()) acts without it where the noise is
/// that of its measurement. To a model that takes it as it is, plays and lags of the input that
/// swallow the noise explain the records better than nothing. In their place the trends of such
/// inputs are tried (levels with jumps or lines with bends, whichever has the lower C_p, see
/// choose_trend()) where such an effect is named or structure is left that the noise of the inputs
/// does not make; it is proposed as an InputSkew is.
class InputSmoothing final : public Configured<Hypothesis, NoOptions<kInputSmoothing>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Assumptions; }
  int do_order() const override { return 1; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

}  // namespace lacuna
