// SPDX-License-Identifier: MIT
#include "trajectories/windows/windows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lacuna/data/records/marks.hpp"
#include "support/assimilated_oscillator.hpp"
#include "trajectories/windows/window_gap.hpp"

namespace lacuna {
namespace {

/// Errors that grow by a factor in each interval, one state.
ErrorGrowth constant_growth(Index samples, double factor) {
  return {Matrix::Constant(samples, 1, factor), 1};
}

Index covered(const WindowPlan& plan) {
  Index sum = 0;
  for (const Window& window : plan) {
    EXPECT_EQ(window.first, sum);
    sum += window.samples;
  }
  return sum;
}

TEST(Windows, EndWhereErrorsHaveGrown) {
  WindowLimits limits{.growth = 3.0, .turn = 1e9, .shortest = 2, .longest = 1000};
  const WindowPlan plan = plan_windows({0, 100}, constant_growth(100, std::exp(0.1)), limits);
  EXPECT_EQ(covered(plan), 100);
  EXPECT_EQ(plan.front().samples, 11);  // exp(0.1 * 10) < 3 < exp(0.1 * 11)
  EXPECT_EQ(plan.front().intervals, 11);
  EXPECT_EQ(plan.back().intervals, plan.back().samples - 1);
}

TEST(Windows, TurningStatesEndWindowsWithoutGrowth) {
  ErrorGrowth rotation{Matrix(50, 4), 2};
  const double angle = 0.5;
  for (Index i = 0; i < 50; ++i)
    rotation.transitions.row(i) << std::cos(angle), std::sin(angle), -std::sin(angle),
        std::cos(angle);
  WindowLimits limits{.growth = 3.0, .turn = 6.3, .shortest = 2, .longest = 1000};
  const WindowPlan plan = plan_windows({0, 50}, rotation, limits);
  EXPECT_EQ(plan.front().samples, 13);  // 6.3 / (2 sin(angle / 2) is 12.7 intervals
  EXPECT_NEAR(largest_growth(plan, rotation), 1.0, 1e-12);
}

TEST(Windows, NeverCrossTrajectories) {
  const WindowPlan plan = equal_windows({0, 25, 40}, 10);
  EXPECT_EQ(covered(plan), 40);
  for (const Window& window : plan)
    EXPECT_TRUE(window.first >= 25 || window.first + window.samples <= 25);
}

TEST(WindowGap, WindowsAreAMeanPeriodLong) {
  // The free oscillation has the period 2 pi / 2; what drives it is as slow.
  const Assimilation fit = support::assimilated(support::hidden_record(support::nothing, 1e-3));
  const Vector& time = fit.records.front().time;
  const double length = static_cast<double>(window_samples(fit)) * (time[1] - time[0]);
  EXPECT_NEAR(length, 3.14, 0.5);
}

TEST(WindowGap, OfTheRightModelIsItsNoise) {
  const Dataset data = support::hidden_record(support::nothing, 0.01, 3);
  const Assimilation fit = support::assimilated(data);
  const Matrix& states = data.trajectories.front().states;
  double expected = 0.0;
  for (Index k = 0; k < 2; ++k) {
    const auto x = states.col(k).array();
    const double noise = k == 0 ? 0.01 : 0.02;
    expected += 0.5 * noise * noise / (x - x.mean()).square().mean();
  }
  EXPECT_NEAR(window_gap(fit), std::sqrt(expected), 0.1 * std::sqrt(expected));
}

TEST(WindowGap, WindowsWithoutASolutionCountForNothingElse) {
  WindowSquares all{4.0, 2.0, 0};
  all.add({std::numeric_limits<double>::quiet_NaN(), 7.0, 0});
  EXPECT_EQ(all.diverged, 1);
  EXPECT_DOUBLE_EQ(all.rms(), std::sqrt(2.0));
}

TEST(WindowGap, IsAboveAFloorByItsScatterOverBlocks) {
  WindowSquares all{30.0, 3.0, 0, {8.0, 10.0, 12.0}};
  // Mean 10, standard error 2 / sqrt(3); two degrees of freedom count 4.303 as 1.96.
  EXPECT_NEAR(all.above(2.0), 6.0 * std::sqrt(3.0) / 2.0 * 1.959964 / 4.302653, 1e-6);
  EXPECT_LT(all.above(4.0), 0.0);
  all.blocks = {10.0};
  EXPECT_EQ(all.above(1.0), 0.0) << "one block has no scatter";
  EXPECT_EQ(WindowSquares{}.above(1.0), 0.0) << "nothing was compared";
}

TEST(WindowGap, CountsWhatLastsAndNotWhatGoesToAndFro) {
  const auto gap_of = [](const support::Hidden& hidden) {
    return window_gap(support::assimilated(support::hidden_record(hidden, 1e-4, 3)));
  };
  const double steady =
      gap_of([](double, double, double v) { return -0.1 * (v > 0.0 ? 1.0 : -1.0); });
  const double quick =
      gap_of([](double t, double, double) { return 0.1 * std::sin(40.0 * t); });
  EXPECT_LT(gap_of(support::nothing), 1e-3);
  EXPECT_GT(steady, 5.0 * quick);
}

TEST(WindowGap, SamplesThatSayNothingAreLeftOutAndEndsCountAsFarAsTheModelStaysShort) {
  Assimilation fit = support::assimilated(support::hidden_record(support::nothing, 0.01));
  const LinearisedRecord& record = fit.records[0];
  const WindowGrid grid{0, 100};
  const Vector scale = Vector::Ones(2);
  Matrix measured = record.path;
  Matrix marks = Matrix::Zero(measured.rows(), 2);
  const auto squares = [&] {
    return window_squares(record, {measured, marks}, fit.noise, scale, grid);
  };
  const WindowSquares whole = squares();
  measured(250, 0) += 5.0;
  marks(250, 0) = number_of(Mark::Outlier);
  EXPECT_NEAR(squares().sum, whole.sum, 1e-3);
  EXPECT_EQ(squares().count, whole.count - 1.0);
  measured(250, 0) -= 7.0;  // the model is far above the upper end
  marks(250, 0) = number_of(Mark::AtTop);
  EXPECT_NEAR(squares().sum, whole.sum, 1e-3);
  EXPECT_EQ(squares().count, whole.count);
}

TEST(WindowGap, AColumnThatNeverMovesMeasuresNothing) {
  Matrix block = Matrix::Constant(7, 3, 0.1);
  block.col(1) = Vector::LinSpaced(7, -1e-100, 1e-100);
  block.col(2).setZero();
  const Vector deviations = moving_deviations({block, block});
  EXPECT_EQ(deviations[0], 0.0) << "up to the rounding of its mean";
  EXPECT_GT(deviations[1], 0.0);
  EXPECT_EQ(deviations[2], 0.0);
  Dataset data = support::hidden_record(support::nothing, 0.01);
  const Assimilation fit = support::assimilated(data);
  Vector scale = Vector::Ones(2);
  const auto count = [&] {
    return window_squares(fit.records[0], {fit.measured[0], {}}, fit.noise, scale, {0, 100})
        .count;
  };
  const double both = count();
  scale[0] = 0.0;
  EXPECT_EQ(count(), 0.5 * both);
}

}  // namespace
}  // namespace lacuna
