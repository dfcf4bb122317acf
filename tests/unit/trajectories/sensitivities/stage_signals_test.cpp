// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/stage_signals.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace lacuna {
namespace {

/// Input t^3, delayed variable t^2 by 0.25, on six samples.
DrivingSamples samples() {
  const Vector time{{0.0, 0.1, 0.2, 0.4, 0.5, 0.6}};
  return {time, time.array().cube(), time.array().square(), {0.25}};
}

StageSignals written(Interpolation interpolation) {
  StageSignals signals = empty_stage_signals({&runge_kutta_4(), 2}, 8, 3);
  DrivingSamples driving = samples();
  driving.signals.assign(
      static_cast<std::size_t>(driving.inputs.cols() + driving.delayed.cols()), interpolation);
  write_stage_signals(driving, 2, signals);
  return signals;
}

TEST(StageSignals, AreThoseOfTheTimesOfTheStages) {
  const StageSignals signals = written(Interpolation::Cubic);
  const Vector time = samples().time;
  ASSERT_GT(time.size(), 0);
  for (Index i = 0; i + 1 < time.size(); ++i)
    for (Index j = 0; j < 2; ++j)
      for (std::size_t a = 0; a < 4; ++a) {
        const Index row = 2 * (2 + i) + j;
        const double h = 0.5 * (time[i + 1] - time[i]);
        const double t = time[i] + static_cast<double>(j) * h + runge_kutta_4().nodes[a] * h;
        const double then = std::max(t - 0.25, 0.0);
        EXPECT_DOUBLE_EQ(signals.lengths[row], h);
        EXPECT_NEAR(signals.stages[a](row, 0), t * t * t, 1e-15);
        EXPECT_NEAR(signals.stages[a](row, 1), t, 1e-15);
        EXPECT_NEAR(signals.stages[a](row, 2), then * then, 1e-15);
      }
}

TEST(StageSignals, StepsBehindTheLastSampleHaveNoLength) {
  const StageSignals signals = written(Interpolation::Cubic);
  EXPECT_EQ(signals.lengths[14], 0.0);
  EXPECT_EQ(signals.lengths[15], 0.0);
  EXPECT_EQ(signals.lengths.head(4), Vector::Zero(4)) << "of another trajectory";
}

TEST(StageSignals, AHeldInputStaysToTheEndOfItsInterval) {
  const StageSignals signals = written(Interpolation::Held);
  const double before = 0.2 * 0.2 * 0.2;
  EXPECT_DOUBLE_EQ(signals.stages[3](2 * (2 + 2) + 1, 0), before);
  EXPECT_DOUBLE_EQ(signals.stages[0](2 * (2 + 3), 0), 0.4 * 0.4 * 0.4);
}

}  // namespace
}  // namespace lacuna
