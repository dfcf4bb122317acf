// SPDX-License-Identifier: MIT
#include "core/base/check.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lacuna {
namespace {

constexpr Index kMost = std::numeric_limits<Index>::max();
constexpr Index kLeast = std::numeric_limits<Index>::min();

TEST(Check, NumbersCountFromZero) {
  EXPECT_NO_THROW(check_number(2, 3, "f", "state"));
  for (const Index number : {Index{-1}, Index{3}, kMost, kLeast})
    EXPECT_THROW(check_number(number, 3, "f", "state"), ArgumentError) << number;
}

TEST(Check, PartsLieInsideWithoutOverflow) {
  EXPECT_NO_THROW(check_part(0, 3, 3, "f"));
  EXPECT_NO_THROW(check_part(3, 0, 3, "f"));
  EXPECT_THROW(check_part(1, 3, 3, "f"), ArgumentError);
  EXPECT_THROW(check_part(-1, 2, 3, "f"), ArgumentError);
  EXPECT_THROW(check_part(1, -1, 3, "f"), ArgumentError);
  EXPECT_THROW(check_part(kMost, kMost, 3, "f"), ArgumentError);
  EXPECT_THROW(check_part(kLeast, kLeast, 3, "f"), ArgumentError);
}

TEST(Check, TimesIncreaseAndAreFinite) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_NO_THROW(check_times(Vector{{-1.0, 0.0, 7.0}}, 3, "f"));
  EXPECT_NO_THROW(check_times(Vector(), 0, "f"));
  EXPECT_THROW(check_times(Vector(), 1, "f"), ArgumentError);
  EXPECT_THROW(check_times(Vector{{0.0, 0.0}}, 1, "f"), ArgumentError);
  EXPECT_THROW(check_times(Vector{{0.0, -1.0}}, 1, "f"), ArgumentError);
  EXPECT_THROW(check_times(Vector{{0.0, kNan, 1.0}}, 1, "f"), ArgumentError);
  EXPECT_THROW(check_times(Vector{{kNan}}, 1, "f"), ArgumentError);
  EXPECT_THROW(check_times(Vector{{0.0, kInfinity}}, 1, "f"), ArgumentError);
  EXPECT_THROW(check_times(Vector{{-kInfinity, 0.0}}, 1, "f"), ArgumentError);
}

}  // namespace
}  // namespace lacuna
