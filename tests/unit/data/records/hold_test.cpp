// SPDX-License-Identifier: MIT
#include "lacuna/data/records/hold.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(Hold, ShowsWhereMostSamplesRepeat) {
  EXPECT_TRUE(shows_hold(Vector{{1.0, 1.0, 1.0, 2.0, 2.0, 2.0}}));
  EXPECT_FALSE(shows_hold(Vector{{1.0, 1.0, 2.0, 3.0, 3.0, 4.0}}));
  EXPECT_TRUE(shows_hold(Vector{{1.0, 1.0, 2.0, 3.0, 3.0, 4.0}}, 0.3));
  EXPECT_FALSE(shows_hold(Vector::Constant(6, 1.0))) << "it never changes";
  EXPECT_FALSE(shows_hold(Vector::Constant(1, 1.0)));
}

}  // namespace
}  // namespace lacuna
