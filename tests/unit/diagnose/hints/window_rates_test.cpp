// SPDX-License-Identifier: MIT
#include "diagnose/hints/window_rates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

using support::hidden_record;
using support::nothing;

TEST(WindowRates, HaveTheSlopeOfALineAndNoneOfAConstant) {
  Dataset data = support::oscillator_record();
  Trajectory& record = data.trajectories[0];
  record.time[7] += 0.004;  // a grid that is not uniform
  record.states.col(0) = 3.0 * record.time.array() + 1e6;
  record.states.col(1).setConstant(-5.0);
  const RateWindows windows{4, {{0, 2}, {0, 100}, {0, 900}}};
  const Matrix rates = window_rates(data, windows);
  EXPECT_LT((rates.col(0).array() - 3.0).abs().maxCoeff(), 1e-7);
  EXPECT_LT(rates.col(1).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(WindowRates, AreTheWeightedMeansOfTheRate) {
  const Dataset data = support::oscillator_record();  // q = sin 2t, v = 2 cos 2t
  const RateWindows windows{6, {{0, 0}, {0, 333}, {0, 988}}};
  const Matrix rates = window_rates(data, windows);
  const Matrix means = window_means(
      data, windows, 1,
      [](const Trajectory& record, Index i, double* out) { *out = record.states(i, 1); });
  EXPECT_LT((rates.col(0) - means).norm(), 1e-5 * means.norm());
}

TEST(RateWindows, AreLongerWhereThereIsMoreNoise) {
  const RateWindows quiet = rate_windows(observed(hidden_record(nothing, 1e-4)));
  const RateWindows loud = rate_windows(observed(hidden_record(nothing, 0.05)));
  EXPECT_EQ(quiet.half_width, 4);
  EXPECT_GT(loud.half_width, 12);
  const BoundRecords records = observed(hidden_record(nothing, 0.05));
  const Vector noise = rate_noise(records, loud);
  const Matrix rest =
      window_rates(records.data, loud) - window_rates(hidden_record(nothing, 0.0), loud);
  const Vector found = rest.colwise().squaredNorm() / static_cast<double>(rest.rows());
  EXPECT_NEAR(found[0] / noise[0], 1.0, 0.4);
  EXPECT_NEAR(found[1] / noise[1], 1.0, 0.4);
}

TEST(RateWindows, LeaveOutOutliersGapsAndMissingValues) {
  BoundRecords records = observed(hidden_record(nothing, 0.01));
  Trajectory& record = records.data.trajectories[0];
  records.outliers[0](200, 1) = 1.0;
  record.states(400, 0) = std::numeric_limits<double>::quiet_NaN();
  record.time.tail(900).array() += 0.5;  // between samples 600 and 601
  const RateWindows windows = rate_windows(records);
  const auto holds = [&](Index sample) {
    return std::any_of(windows.windows.begin(), windows.windows.end(),
                       [&](const RateWindow& w) {
                         return w.first <= sample && sample < w.first + windows.samples();
                       });
  };
  EXPECT_TRUE(holds(150) && holds(300) && holds(500) && holds(700));
  EXPECT_FALSE(holds(200));
  EXPECT_FALSE(holds(400));
  EXPECT_FALSE(holds(601) && std::any_of(windows.windows.begin(), windows.windows.end(),
                                         [&](const RateWindow& w) {
                                           return w.first <= 600 &&
                                                  w.first + windows.samples() > 601;
                                         }));
}

}  // namespace
}  // namespace lacuna
