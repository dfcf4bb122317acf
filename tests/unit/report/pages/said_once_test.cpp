// SPDX-License-Identifier: MIT
#include "report/pages/folded_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lacuna {
namespace {

using ::testing::ElementsAre;

TEST(SaidOnce, PlacesStandTogetherInFrontOfWhatIsSaidOfThem) {
  EXPECT_THAT(said_once({"a.csv: the column s is text", "nothing moves",
                         "b.csv: the column s is text", "a.csv: time jumps"}),
              ElementsAre("a.csv, b.csv: the column s is text", "nothing moves",
                          "a.csv: time jumps"));
  EXPECT_THAT(said_once({"a.csv:4:3: no value", "a.csv:9:3: no value", "b.csv:1:3: no value"}),
              ElementsAre("a.csv:4:3 and 2 more: no value"));
}

TEST(SaidOnce, WhatIsThereTwiceStandsOnce) {
  EXPECT_THAT(said_once({"a: b", "c", "a: b", "c"}), ElementsAre("a: b", "c"));
  EXPECT_THAT(said_once({}), ElementsAre());
}

/// Colons inside of what is said are no places.
TEST(SaidOnce, NumbersThatDifferAreSaidApart) {
  EXPECT_THAT(said_once({"clipped: x at 5: 3 %", "clipped: v at 5: 3 %"}),
              ElementsAre("clipped: x at 5: 3 %", "clipped: v at 5: 3 %"));
}

}  // namespace
}  // namespace lacuna
