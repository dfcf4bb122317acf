// SPDX-License-Identifier: MIT
#include "core/base/json_text.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(JsonText, GivesLineAndColumn) {
  EXPECT_EQ(line_and_column("ab\ncd", 1), "1:1");
  EXPECT_EQ(line_and_column("ab\ncd", 5), "2:2");
  EXPECT_EQ(line_and_column("ab\ncd", 0), "1:1");
  EXPECT_EQ(line_and_column("ab", 100), "1:3");
}

TEST(JsonText, FindsTheNumberThatIsTooLarge) {
  EXPECT_EQ(overflowing_number(R"({"a": 1e308, "b": [2, -1e999]})"), 23u);
  EXPECT_EQ(overflowing_number(R"({"1e999": "1e999\" 1e999", "b": 1e-999})"), std::nullopt);
  EXPECT_EQ(overflowing_number("\"open 1e999"), std::nullopt);
}

TEST(JsonText, FindsTheLevelThatIsTooDeep) {
  EXPECT_EQ(deeper_than(2, R"({"a": [1, [2]]})"), 11u);
  EXPECT_EQ(deeper_than(3, R"({"a": [1, [2]]})"), std::nullopt);
  EXPECT_EQ(deeper_than(1, R"(["[[[", "\"[[["])"), std::nullopt);
  EXPECT_EQ(deeper_than(1, "]]][1][2]"), std::nullopt);
  EXPECT_EQ(deeper_than(1, "[\"["), std::nullopt);
}

}  // namespace
}  // namespace lacuna
