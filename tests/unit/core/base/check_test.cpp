// SPDX-License-Identifier: MIT
#include "core/base/check.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/finite.hpp"
#include "core/base/json.hpp"
#include "core/base/json_text.hpp"
#include "lacuna/core/base/error.hpp"

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

TEST(Error, SaysWhereWhatAndRemedyInOneLine) {
  const DataError error("run.csv:12:3", "'abc' is not a number", "leave the field empty");
  EXPECT_STREQ(error.what(), "run.csv:12:3: 'abc' is not a number; leave the field empty");
  EXPECT_EQ(error.where(), "run.csv:12:3");
  EXPECT_EQ(error.problem(), "'abc' is not a number");
  EXPECT_EQ(error.remedy(), "leave the field empty");
}

TEST(Error, LeavesEmptyPartsOut) {
  EXPECT_STREQ(Error("", "bad", "").what(), "bad");
  EXPECT_STREQ(Error("here", "bad", "").what(), "here: bad");
  EXPECT_STREQ(Error("", "bad", "mend it").what(), "bad; mend it");
}

TEST(AllFinite, SeesOneValueThatIsNone) {
  Matrix values = Matrix::Random(70001, 2) * 1e300;
  values(5, 0) = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(all_finite(values));
  EXPECT_TRUE(all_finite(Matrix()));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()})
    for (const Index row : {Index{0}, Index{65535}, Index{65536}, Index{70000}}) {
      Matrix spoilt = values;
      spoilt(row, 1) = bad;
      for (const int threads : {1, 3}) {
        EXPECT_FALSE(all_finite(spoilt, threads)) << bad << ' ' << row;
        EXPECT_TRUE(all_finite(values, threads));
      }
      EXPECT_FALSE(all_finite(spoilt)) << bad << ' ' << row;
      EXPECT_TRUE(all_finite(spoilt.col(0)));
    }
}

constexpr const char* kText = "{\"b\": [1, 0.1, 1e-5, 2.0], \"a\": null}";

TEST(Json, KeepsTheOrderOrSorts) {
  EXPECT_EQ(json_line(ordered_json(kText)), "{\"b\":[1,0.1,1e-05,2.0],\"a\":null}");
  EXPECT_EQ(json_line(sorted_json(kText)), "{\"a\":null,\"b\":[1,0.1,1e-05,2.0]}");
}

TEST(Json, IsIndentedByLevels) {
  EXPECT_EQ(json_lines(ordered_json("{\"b\":{\"a\":1}}")),
            "{\n  \"b\": {\n    \"a\": 1\n  }\n}\n");
  EXPECT_EQ(json_lines(ordered_json("[1]"), 1), "[\n 1\n]\n");
}

TEST(Json, HasReplacementsForWhatIsNoUtf8) {
  EXPECT_EQ(json_line(OrderedJson("a\xff")), "\"a\xef\xbf\xbd\"");
  EXPECT_EQ(json_line(SortedJson("a\xff")), "\"a\xef\xbf\xbd\"");
  EXPECT_EQ(json_lines(OrderedJson("a\xff")), "\"a\xef\xbf\xbd\"\n");
}

TEST(Json, IsToldFromText) {
  EXPECT_TRUE(is_json("1.5"));
  EXPECT_TRUE(is_json("[1, 2]"));
  EXPECT_FALSE(is_json("irls"));
  EXPECT_FALSE(is_json("[1, 2"));
  EXPECT_THROW(ordered_json("[1, 2"), nlohmann::json::parse_error);
  EXPECT_THROW(sorted_json("[1, 2"), nlohmann::json::parse_error);
}

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
