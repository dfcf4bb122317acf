// SPDX-License-Identifier: MIT
#include "data/records/columns/many_valued.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "unit/data/records/columns/rate_columns.hpp"

namespace lacuna {
namespace {

using testing::named_columns;
using testing::states_and_rates;

TEST(IsManyValued, RatesAreFunctionsOfAllStates) {
  for (const double noise : {0.0, 0.05})
    for (const Index n : {200, 1000, 5000}) {
      const double step = 20.0 / static_cast<double>(n);
      const Dataset cycle =
          named_columns({states_and_rates(testing::lotka_volterra, Vector{{0.4, 0.7}}, n, step)},
                        {0, 1, 2, 3}, {"x", "y", "dx", "dy"}, noise);
      EXPECT_FALSE(is_many_valued(cycle, {2, 3}, {0, 1})) << noise << " " << n;
      const Dataset chaos = named_columns(
          {states_and_rates(testing::lorenz, Vector{{1.0, 2.0, 20.0}}, n, step)},
          {0, 1, 2, 3, 4, 5}, {"x", "y", "z", "dx", "dy", "dz"}, noise);
      EXPECT_FALSE(is_many_valued(chaos, {3, 4, 5}, {0, 1, 2})) << noise << " " << n;
    }
}

TEST(IsManyValued, VelocitiesAreNoFunctionsOfPositions) {
  for (const double noise : {0.0, 0.05, 0.1})
    for (const Index n : {200, 1000, 5000}) {
      const double step = 20.0 / static_cast<double>(n);
      const Dataset swing =
          named_columns({states_and_rates(testing::pendulum, Vector{{1.4, 0.7}}, n, step)},
                        {0, 1}, {"th", "th_dot"}, noise);
      EXPECT_TRUE(is_many_valued(swing, {1}, {0})) << noise << " " << n;
      const Dataset masses = named_columns(
          {states_and_rates(testing::two_masses, Vector{{0.3, 0.1, 0.2, -0.1}}, n, 3.0 * step)},
          {0, 1, 2, 3}, {"x", "y", "x_dot", "y_dot"}, noise);
      EXPECT_TRUE(is_many_valued(masses, {2, 3}, {0, 1})) << noise << " " << n;
    }
}

/// Two records that run through the same positions with unlike velocities.
TEST(IsManyValued, ComparesRecords) {
  const auto decay = [](double rate) {
    return states_and_rates([rate](double, const Vector& x) { return Vector(-rate * x); },
                            Vector{{1.0}}, 200, 0.01);
  };
  const std::vector<std::string> names{"x", "dx"};
  EXPECT_FALSE(is_many_valued(named_columns({decay(1.0)}, {0, 1}, names), {1}, {0}));
  EXPECT_FALSE(
      is_many_valued(named_columns({decay(1.0), decay(1.0)}, {0, 1}, names), {1}, {0}));
  EXPECT_TRUE(
      is_many_valued(named_columns({decay(1.0), decay(3.0)}, {0, 1}, names), {1}, {0}));
}

TEST(IsManyValued, InputsDetermineToo) {
  Trajectory record =
      states_and_rates(testing::driven, Vector{{0.4, 0.7}}, 2000, 0.05);
  const Dataset free = named_columns({record}, {0, 1, 3}, {"x", "v", "a"});
  EXPECT_TRUE(is_many_valued(free, {2}, {0, 1}));
  Dataset known = free;
  known.inputs = {{"u", ""}};
  known.trajectories[0].inputs = record.time.unaryExpr(&testing::drive);
  EXPECT_FALSE(is_many_valued(known, {2}, {0, 1}));
}

TEST(IsManyValued, ShowsNothingOfFewSamples) {
  const Dataset few = named_columns(
      {states_and_rates(testing::pendulum, Vector{{1.4, 0.7}}, 5, 1.0)}, {0, 1}, {"x", "dx"});
  EXPECT_FALSE(is_many_valued(few, {1}, {0}));
  EXPECT_FALSE(is_many_valued(few, {}, {0}));
  EXPECT_THROW(is_many_valued(few, {2}, {0}), ArgumentError);
}

}  // namespace
}  // namespace lacuna
