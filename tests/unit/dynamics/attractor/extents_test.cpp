// SPDX-License-Identifier: MIT
#include "dynamics/attractor/extents.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Dataset record_of_columns(const Vector& x, const Vector& y) {
  Trajectory run;
  run.source = "made";
  run.time = Vector::LinSpaced(x.size(), 0.0, static_cast<double>(x.size() - 1));
  run.states.resize(x.size(), 2);
  run.states << x, y;
  Dataset record;
  record.states = {{"x", "V"}, {"y", "V"}};
  record.trajectories = {run};
  return record;
}

TEST(AttractorExtents, SizesAreThoseOfTheWholeRecord) {
  const Dataset record =
      record_of_columns(Vector{{0, 1, 0, 2, 1, 3}}, Vector{{5, 5, 1, 2, 3, 3}});
  const AttractorExtents extents = attractor_extents(record, 2);
  EXPECT_EQ(extents.size, (Vector{{3.0, 4.0}}));
  EXPECT_EQ(extents.volume, 12.0);
}

TEST(AttractorExtents, IntervalIsThatOfTheMeanOfTheBlocks) {
  // Blocks of x: sizes 1, 2, 3; mean 2, s = 1; t for 2 degrees of freedom is 4.3027.
  const Dataset record =
      record_of_columns(Vector{{0, 1, 0, 2, 0, 3}}, Vector{{0, 1, 0, 1, 0, 1}});
  const AttractorExtents extents = attractor_extents(record, 3);
  EXPECT_NEAR(extents.half_width[0], 4.302653 / std::sqrt(3.0), 1e-5);
  EXPECT_EQ(extents.half_width[1], 0.0);
  EXPECT_NEAR(extents.volume_half_width, extents.half_width[0], 1e-12);
}

TEST(AttractorExtents, TrajectoriesCountTogether) {
  Dataset record = record_of_columns(Vector{{0, 1, 0, 1}}, Vector{{0, 1, 0, 1}});
  record.trajectories.push_back(record.trajectories[0]);
  record.trajectories[1].states.array() += 10.0;
  EXPECT_EQ(attractor_extents(record, 2).size, (Vector{{11.0, 11.0}}));
}

}  // namespace
}  // namespace lacuna
