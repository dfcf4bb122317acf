// SPDX-License-Identifier: MIT
#include "diagnose/hints/slip_search.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

const OdeModel kSearched = support::oscillator();  // q, v; F

double friction(double, double, double v) { return v > 0.0 ? -0.5 : 0.5; }

/// What is found in a record to which something was done; `q`, `v`, `F` and time may be scaled.
std::optional<FoundSlip> found(double time, double q, double v, double force,
                               const support::Hidden& hidden = friction) {
  Dataset data = support::hidden_record(hidden, 0.01);
  Trajectory& record = data.trajectories[0];
  record.time *= time;
  record.states.col(0) *= q;
  record.states.col(1) *= v;
  record.inputs *= force;
  const BoundRecords records = observed(std::move(data));
  return find_slip(kSearched, records.data, rate_windows(records), {});
}

TEST(Misfit, IsZeroOneOrTwo) {
  const Matrix y = Vector{{1.0, -1.0, 2.0, -2.0}};
  const Matrix z = Vector{{1.0, 1.0, 2.0, 2.0}};
  EXPECT_LT(misfit(y, y)[0], 1e-12);
  EXPECT_DOUBLE_EQ(misfit(y, z)[0], 1.0) << "nothing to do with one another";
  EXPECT_DOUBLE_EQ(misfit(y, -y)[0], 2.0);
  EXPECT_NEAR(misfit(y, 3.0 * y)[0], 4.0 / 10.0, 1e-12);
  Matrix lost = y;
  lost(2, 0) = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(misfit(y, lost)[0], 2.0) << "a quarter is not finite";
}

TEST(FindSlip, FindsNoneWhereAnEffectIsMissing) {
  EXPECT_FALSE(found(1.0, 1.0, 1.0, 1.0));
  EXPECT_FALSE(found(1.0, 1.0, 1.0, 1.0, support::nothing));
  EXPECT_FALSE(found(1.0, 1.0, 1.0, 1.0, [](double, double q, double) { return -30 * q; }))
      << "a spring 8.5 times too soft is no unit";
}

TEST(FindSlip, ListsWhatIsNotToldApart) {
  // x' = u alone, and x a hundred times too small.
  const Variables variables{{"x"}, {"u"}};
  const OdeModel integrator({{"x", ""}}, {{"u", ""}}, {{{Term::parse("u", variables), 1.0}}});
  Dataset data;
  data.states = {{"x", ""}};
  data.inputs = {{"u", ""}};
  Trajectory record;
  record.time = Vector::LinSpaced(801, 0.0, 40.0);
  record.states = 0.01 * record.time.array().sin().matrix();
  record.inputs = record.time.array().cos().matrix();
  data.trajectories = {record};
  const BoundRecords records = observed(std::move(data));
  const auto slip = find_slip(integrator, records.data, rate_windows(records), {});
  ASSERT_TRUE(slip);
  EXPECT_EQ(slip->slip.kind, HintKind::TimeUnit);
  ASSERT_EQ(slip->others.size(), 2u) << "x or u";
  EXPECT_DOUBLE_EQ(slip->others[0].correction * slip->others[1].correction, 1.0);
}

}  // namespace
}  // namespace lacuna
