// SPDX-License-Identifier: MIT
#include "model/files/strict_json.hpp"

#include <gtest/gtest.h>

#include <string>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

std::string json_message(const std::string& text) {
  try {
    parse_strict_json(text, "f");
  } catch (const ModelError& error) {
    return error.where() + "|" + error.problem();
  }
  return "no error";
}

TEST(StrictJson, ARepeatedKeyIsNamedByItsPath) {
  const std::string problem = "|the key stands twice in its object";
  EXPECT_EQ(json_message(R"({"a": 1, "a": 2})"), "f: $.a" + problem);
  EXPECT_EQ(json_message(R"({"b": [1, [], {"c": {"d": 1, "e": 2, "d": 3}}]})"),
            "f: $.b[2].c.d" + problem);
  EXPECT_EQ(json_message(R"([[{"a": 1}, {"b": 1, "b": 1}]])"), "f: $[0][1].b" + problem);
  EXPECT_EQ(json_message(R"({"a": {"b": 1}, "c": {"b": 1}, "b": [{"b": 1}, {"b": 1}]})"),
            "no error");
}

TEST(StrictJson, APositionIsLineAndColumn) {
  EXPECT_EQ(json_message("{\n \"a\": }"), "f:2:7|not valid JSON");
  EXPECT_EQ(json_message("[1, 2"), "f:1:6|the JSON text ends too early");
  EXPECT_EQ(json_message(" \n "), "f:2:2|the file is empty");
  EXPECT_EQ(json_message("[1] 2"), "f:1:5|not valid JSON");
}

TEST(StrictJson, LevelsAreBounded) {
  const auto nested = [](std::size_t levels) {
    return std::string(levels, '[') + std::string(levels, ']');
  };
  EXPECT_EQ(json_message(nested(kDeepestJson)), "no error");
  const std::string problem = "f:1:33|nested deeper than 32 levels";
  EXPECT_EQ(json_message(nested(kDeepestJson + 1)), problem);
  EXPECT_EQ(json_message(nested(1000000)), problem);
  EXPECT_EQ(json_message(std::string(1000000, '[')), problem);
}

}  // namespace
}  // namespace lacuna
