// SPDX-License-Identifier: MIT
#include "lacuna/records/channels/node_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/data/records/marks.hpp"
#include "records/channels/interpolated.hpp"

namespace lacuna {
namespace {

const Vector kNodeTime{{0.0, 0.1, 0.3, 0.4, 0.5, 0.7, 0.8}};

TEST(NodeTimes, DivideEachInterval) {
  const Vector nodes = node_times(Vector{{0.0, 1.0, 3.0}}, 4);
  ASSERT_EQ(nodes.size(), 9);
  EXPECT_DOUBLE_EQ(nodes[3], 0.75);
  EXPECT_DOUBLE_EQ(nodes[5], 1.5);
  EXPECT_EQ(nodes[8], 3.0);
}

TEST(NodeSlots, HoldTheSamplesAndACubicBetween) {
  Matrix values(7, 2);
  values << kNodeTime.array().cube(), Vector::Random(7);
  const Matrix slots = node_slots(kNodeTime, values, 2);
  ASSERT_EQ(slots.rows(), 13);
  ASSERT_EQ(slots.cols(), 3);
  const Vector at_samples = slots.col(1)(Eigen::seq(0, 12, 2));
  EXPECT_EQ(at_samples, values.col(1)) << "to the bit";
  EXPECT_LT((slots.col(0).array() - slots.col(2).array().cube()).abs().maxCoeff(), 1e-15);
  EXPECT_DOUBLE_EQ(slots(3, 2), 0.2);
}

TEST(NodeSlots, GoOnBetweenSamplesAsTold) {
  const Matrix values = Vector::LinSpaced(7, 0.0, 6.0).array().square();
  EXPECT_EQ(node_slots(kNodeTime, values, 2, Interpolation::Held)(5, 0), 4.0);
  EXPECT_DOUBLE_EQ(node_slots(kNodeTime, values, 2, Interpolation::Linear)(5, 0), 6.5);
}

TEST(DelayedSlots, AreWhatWasBefore) {
  Matrix values(7, 1);
  values << kNodeTime.array().square();
  const Matrix slots = node_slots(kNodeTime, values, 4);
  const Matrix past = delayed_slots(slots, 4, {{0, 0.15}});
  ASSERT_EQ(past.cols(), 1);
  for (Index i = 0; i < slots.rows(); ++i) {
    const double then = std::max(slots(i, 1) - 0.15, 0.0);
    EXPECT_NEAR(past(i, 0), then * then, 1e-14) << "the first sample holds before it";
  }
}

TEST(StepGrid, IsThatOfNodesWhileNothingJumps) {
  const Matrix values = kNodeTime.array().cube();
  const StepGrid grid = step_grid({Interpolation::Cubic});
  EXPECT_EQ(step_slots(kNodeTime, values, grid), node_slots(kNodeTime, values, 2));
}

TEST(StepGrid, AHeldSignalJumpsBetweenTheEndOfAStepAndTheNextBegin) {
  Matrix values(kNodeTime.size(), 2);
  values << Vector::LinSpaced(kNodeTime.size(), 1.0, static_cast<double>(kNodeTime.size())),
      kNodeTime;
  const StepGrid grid = step_grid({Interpolation::Held, Interpolation::Linear});
  ASSERT_EQ(grid.stride, 3);
  const Matrix slots = step_slots(kNodeTime, values, grid);
  ASSERT_EQ(slots.rows(), 3 * (kNodeTime.size() - 1) + 1);
  for (Index i = 0; i + 1 < kNodeTime.size(); ++i) {
    const double h = kNodeTime[i + 1] - kNodeTime[i];
    EXPECT_EQ(slots(grid.begin(i), 0), static_cast<double>(i + 1));
    EXPECT_EQ(slots(grid.middle(i), 0), static_cast<double>(i + 1));
    EXPECT_EQ(slots(grid.end(i), 0), static_cast<double>(i + 1));
    EXPECT_NEAR(slots(grid.middle(i), 1), kNodeTime[i] + 0.5 * h, 1e-15);
    EXPECT_EQ(slots(grid.end(i), 2), kNodeTime[i + 1]);
  }
  EXPECT_EQ(slots(slots.rows() - 1, 0), static_cast<double>(kNodeTime.size()));
}

/// The integral over a step by Simpson's rule is that of the delayed steps.
TEST(StepGrid, DelayedHeldSignalsKeepTheirIntegral) {
  const Vector time = Vector::LinSpaced(8, 0.0, 0.7);
  const Vector values{{1.0, 1.0, 4.0, -2.0, -2.0, 0.0, 3.0, 3.0}};
  const StepGrid grid = step_grid({Interpolation::Held});
  const Matrix slots = step_slots(time, values, grid);
  const Matrix past = delayed_step_slots(slots, grid, {{0, 0.13}});
  for (Index i = 2; i + 1 < 8; ++i) {
    const Eigen::Vector3d line = past.col(0).segment<3>(grid.begin(i));
    const double mean = (line[0] + 4.0 * line[1] + line[2]) / 6.0;
    EXPECT_NEAR(mean, 0.3 * values[i - 2] + 0.7 * values[i - 1], 1e-12);
    EXPECT_GE(line.minCoeff(), values.minCoeff() - 1e-12);
    EXPECT_LE(line.maxCoeff(), values.maxCoeff() + 1e-12);
  }
  const Matrix exact = delayed_step_slots(slots, grid, {{0, 0.13, true}});
  for (Index i = 2; i + 1 < 8; ++i) {
    const Eigen::Vector3d curve = exact.col(0).segment<3>(grid.begin(i));
    const double before = values[i - 2], after = values[i - 1], jump = -0.4;  // at 0.3 of it
    EXPECT_NEAR((curve[0] + 4.0 * curve[1] + curve[2]) / 6.0, 0.3 * before + 0.7 * after, 1e-12);
    // The integral of x from -1 to 1, by Simpson's rule, is that of the two steps.
    EXPECT_NEAR((curve[2] - curve[0]) / 3.0, 0.5 * (after - before) * (1.0 - jump * jump), 1e-12);
  }
  const Matrix whole = delayed_step_slots(slots, grid, {{0, 0.2}});
  for (Index i = 2; i + 1 < 8; ++i)
    for (Index q = 0; q < 3; ++q)
      EXPECT_NEAR(whole(grid.begin(i) + q, 0), values[i - 2], 1e-9) << "whole steps";
}

const Vector kTime = Vector::LinSpaced(2001, 0.0, 20.0);

/// sin(2 t) with noise.
Vector noisy_sine(double noise) {
  Random random(4);
  Vector values(kTime.size());
  for (Index i = 0; i < values.size(); ++i)
    values[i] = std::sin(2.0 * kTime[i]) + noise * random.normal();
  return values;
}

/// Every `each`-th sample of a signal from `first` on, and lines between.
Vector on_lines(const Vector& values, Index each, double first = 0.0) {
  Vector result(values.size());
  for (Index i = 0; i < result.size(); ++i) {
    const double place = (static_cast<double>(i) - first) / static_cast<double>(each);
    const double before = first + std::floor(place) * static_cast<double>(each);
    const auto at = [&](double sample) {
      return values[std::clamp<Index>(std::lround(sample), 0, values.size() - 1)];
    };
    const double fraction = place - std::floor(place);
    result[i] =
        (1.0 - fraction) * at(before) + fraction * at(before + static_cast<double>(each));
  }
  return result;
}

TEST(InterpolatedSamples, AreThoseBetweenTheOnesOfASlowerChannel) {
  for (const double noise : {0.0, 0.01}) {
    const auto found = interpolated_samples(kTime, on_lines(noisy_sine(noise), 5), 1e-9);
    ASSERT_EQ(found.size(), 1600u) << noise;
    EXPECT_EQ(found[0], 1);
    EXPECT_EQ(found[4], 6) << "the fifth was measured";
  }
}

TEST(InterpolatedSamples, AreFoundWhereTheSlowerChannelHasOtherTimes) {
  const auto found = interpolated_samples(kTime, on_lines(noisy_sine(0.01), 5, 2.5), 1e-9);
  // Of each five the two beside the bend are kept: one value each that was not measured.
  EXPECT_NEAR(static_cast<double>(found.size()), 1200.0, 3.0);
}

TEST(InterpolatedSamples, AreNoneOfASignalThatWasSampled) {
  for (const double noise : {0.0, 1e-9, 1e-6, 0.01}) {
    EXPECT_TRUE(interpolated_samples(kTime, noisy_sine(noise), 1e-6).empty()) << noise;
    EXPECT_TRUE(interpolated_samples(kTime, noisy_sine(noise), 1e-4).empty()) << noise;
  }
}

TEST(InterpolatedSamples, AreNoneOfStretchesThatAreNearlyStraightWhereverTheyBegin) {
  const Vector fast = (7.0 * kTime.array()).sin();
  EXPECT_TRUE(interpolated_samples(kTime, fast, 2e-3).empty());
}

TEST(InterpolatedSamples, AreNoneOfRoundedOrHeldValuesLinesAndRest) {
  const Vector rounded = (noisy_sine(0.0).array() / 0.02).round() * 0.02;
  EXPECT_TRUE(interpolated_samples(kTime, rounded, 0.0).empty());
  EXPECT_TRUE(interpolated_samples(kTime, kTime, 1e-9).empty());
  Vector held = noisy_sine(0.01);
  for (Index i = 0; i < held.size(); ++i) held[i] = held[i - i % 5];
  EXPECT_TRUE(interpolated_samples(kTime, held, 1e-9).empty());
  Vector resting = noisy_sine(0.0);
  resting.segment(500, 200).setConstant(resting[500]);
  EXPECT_TRUE(interpolated_samples(kTime, resting, 1e-9).empty());
}

TEST(InterpolatedSamples, OfStatesSayNothing) {
  Dataset data;
  data.states = {{"x", "V"}, {"y", "V"}};
  Trajectory record;
  record.time = kTime;
  record.states.resize(kTime.size(), 2);
  record.states.col(0) = noisy_sine(0.01);
  record.states.col(1) = on_lines(noisy_sine(0.01), 4);
  data.trajectories = {std::move(record)};
  const Matrix marks = marks_of(with_interpolated_marked(data).trajectories[0]);
  EXPECT_EQ((marks.col(0).array() != 0.0).count(), 0);
  EXPECT_EQ((marks.col(1).array() == number_of(Mark::Missing)).count(), 1500);
}

}  // namespace
}  // namespace lacuna
