// SPDX-License-Identifier: MIT
#include "lacuna/data/records/hold.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(Hold, NamesAreReadAsTheyAreWritten) {
  for (const Hold hold : {Hold::Zero, Hold::Linear, Hold::Smooth, Hold::Switching})
    EXPECT_EQ(hold_named(to_string(hold)), hold);
  EXPECT_EQ(hold_named("cubic"), std::nullopt);
  EXPECT_EQ(hold_named(""), std::nullopt);
}

TEST(Hold, SaysTheCurveBetweenSamples) {
  EXPECT_EQ(interpolation_of(Hold::Zero), Interpolation::Held);
  EXPECT_EQ(interpolation_of(Hold::Linear), Interpolation::Linear);
  EXPECT_EQ(interpolation_of(Hold::Switching), Interpolation::Linear);
  EXPECT_EQ(interpolation_of(std::nullopt), Interpolation::Quintic);
}

TEST(Hold, ShowsWhereMostSamplesRepeat) {
  EXPECT_TRUE(shows_hold(Vector{{1.0, 1.0, 1.0, 2.0, 2.0, 2.0}}));
  EXPECT_FALSE(shows_hold(Vector{{1.0, 1.0, 2.0, 3.0, 3.0, 4.0}}));
  EXPECT_TRUE(shows_hold(Vector{{1.0, 1.0, 2.0, 3.0, 3.0, 4.0}}, 0.3));
  EXPECT_FALSE(shows_hold(Vector::Constant(6, 1.0))) << "it never changes";
  EXPECT_FALSE(shows_hold(Vector::Constant(1, 1.0)));
}

}  // namespace
}  // namespace lacuna
