// SPDX-License-Identifier: MIT
#include "core/base/json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
