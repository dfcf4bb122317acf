// SPDX-License-Identifier: MIT
#include "diagnose/hints/coefficient_pattern.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

const OdeModel kModel = support::oscillator();  // q, v; F

/// A stop so hard that it makes up most of dv/dt.
double stop(double, double q, double) { return q > 0.3 ? -60.0 * (q - 0.3) : 0.0; }

BoundRecords record(double time, double q, double v, const support::Hidden& hidden) {
  Dataset data = support::hidden_record(hidden, 0.002);
  Trajectory& run = data.trajectories[0];
  run.time *= time;
  run.states.col(0) *= q;
  run.states.col(1) *= v;
  return observed(std::move(data));
}

std::optional<FoundSlip> found(double time, double q, double v,
                               const support::Hidden& hidden = stop) {
  const BoundRecords records = record(time, q, v, hidden);
  return slip_of_coefficients(kModel, records.data, rate_windows(records), {});
}

TEST(SlipOfCoefficients, IsSeenBesideALargeEffect) {
  const auto time = found(1000.0, 1.0, 1.0);
  ASSERT_TRUE(time);
  EXPECT_EQ(time->slip.kind, HintKind::TimeUnit);
  EXPECT_DOUBLE_EQ(time->slip.correction, 1e-3);
  const auto unit = found(1.0, 1.0, 100.0);
  ASSERT_TRUE(unit) << "v too large, or q too small where the effect hides the rest";
  std::vector<Slip> all = unit->others;
  all.push_back(unit->slip);
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const Slip& slip) {
    return slip.channels == std::vector<Index>{1} && slip.correction == 0.01;
  }));
}

TEST(SlipOfCoefficients, IsNoneWhereCoefficientsAreBentOrAFactorIsSmall) {
  EXPECT_FALSE(found(1.0, 1.0, 1.0));
  EXPECT_FALSE(found(1.0, 1.0, 1.0, support::nothing));
  EXPECT_FALSE(found(10.0, 1.0, 1.0)) << "an effect may do that";
}

}  // namespace
}  // namespace lacuna
