// SPDX-License-Identifier: MIT
#include "trajectories/refiners/window_iterations.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

/// Rounds after which an approach ends, as many as there are changes where it does not.
std::size_t rounds_of(const std::vector<Change>& changes) {
  Approach approach;
  for (std::size_t i = 0; i < changes.size(); ++i)
    if (!approach.goes_on(changes[i])) return i + 1;
  return changes.size();
}

TEST(Approach, GoesOnWhileItsMovesAreHalved) {
  EXPECT_EQ(rounds_of({{true, 9.0}, {false, 5.0}, {false, 2.0}, {false, 1.9}, {false, 0.4}}), 5u);
  EXPECT_EQ(rounds_of({{false, 5.0}, {false, 6.0}, {false, 2.0}, {false, 3.0}, {false, 1.0}}),
            5u);
}

TEST(Approach, EndsWhereMovesGoUpAndDown) {
  EXPECT_EQ(rounds_of({{false, 5.0}, {false, 0.5}, {false, 6.0}, {false, 2.0}, {false, 0.1}}),
            4u);
}

TEST(Approach, EndsWhereMovesShrinkSlowly) {
  EXPECT_EQ(rounds_of({{false, 5.0}, {false, 4.0}, {false, 3.0}, {false, 2.6}}), 3u);
}

TEST(Approach, BeginsAnewWithOtherTerms) {
  EXPECT_EQ(rounds_of({{false, 0.5}, {false, 6.0}, {true, 9.0}, {false, 4.0}, {false, 2.0}}), 5u);
}

TEST(Approach, NoChangeIsASmallMoveOfTheSameTerms) {
  EXPECT_TRUE((Change{false, 0.5 * kSmallMove}.is_none()));
  EXPECT_FALSE((Change{true, 0.0}.is_none()));
  EXPECT_FALSE((Change{false, 2.0 * kSmallMove}.is_none()));
}

}  // namespace
}  // namespace lacuna
