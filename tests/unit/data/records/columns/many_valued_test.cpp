// SPDX-License-Identifier: MIT
#include "data/records/columns/many_valued.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "unit/data/records/columns/rate_columns.hpp"

namespace lacuna {
namespace {

using testing::named_columns;
using testing::states_and_rates;

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

}  // namespace
}  // namespace lacuna
