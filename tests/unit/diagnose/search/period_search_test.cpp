// SPDX-License-Identifier: MIT
#include "diagnose/search/period_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

constexpr double kPeriod = 0.31;

/// Along the way a force that repeats.
double teeth(double, double q, double) {
  return 1.5 * std::sin(2.0 * std::numbers::pi * q / kPeriod + 0.4);
}

TEST(PeriodSearch, FindsWhatRepeatsAlongAVariable) {
  const Assimilation fit = support::assimilated(support::hidden_record(teeth, 0.002));
  const auto found = best_period(fit, 1, 0);
  ASSERT_TRUE(found);
  const auto q = fit.records.front().path.col(0).array();
  const double range = q.maxCoeff() - q.minCoeff();
  // A quarter of the width of a peak: periods range / n with n known to a quarter.
  EXPECT_NEAR(range / found->longest, range / kPeriod, 0.25);
  EXPECT_LT(found->shortest, kPeriod);
}

TEST(PeriodSearch, TriesAQuarterOfAPeriodInTheRangeAtATime) {
  const Assimilation fit = support::assimilated(support::hidden_record(teeth, 0.002));
  const auto found = best_period(fit, 1, 0);
  ASSERT_TRUE(found);
  const auto q = fit.records.front().path.col(0).array();
  const double range = q.maxCoeff() - q.minCoeff();
  const double most = range / found->shortest;  // periods in the range, two at least
  EXPECT_NEAR(static_cast<double>(found->tried), 4.0 * (most - 2.0) + 1.0, 1.5);
}

TEST(PeriodSearch, AVariableThatStandsStillHasNone) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories.front().inputs.setZero();
  const Assimilation fit = support::assimilated(data);
  EXPECT_FALSE(best_period(fit, 1, 2));
}

}  // namespace
}  // namespace lacuna
