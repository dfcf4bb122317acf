// SPDX-License-Identifier: MIT
#include "data/records/text_field.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using Kind = TextField::Kind;

std::vector<std::string_view> fields_of(std::string_view line, char delimiter) {
  std::vector<std::string_view> fields{"left over"};
  split_fields(line, delimiter, fields);
  return fields;
}

TEST(ReadField, MissingValues) {
  for (const char* text :
       {"", "  ", "NaN", "nan", "-nan", "NA", "n/a", "null", "None", "\"\"", "n.d.", "ND", "-",
        "#NV", "#N/A"}) {
    EXPECT_EQ(read_field(text).kind, Kind::Missing) << text;
    EXPECT_TRUE(std::isnan(read_field(text).value)) << text;
  }
}

TEST(ReadField, Text) {
  for (const char* text : {"abc", "1.5x", "1,2,3", "1.23,4", "1.2345,6", "1.234,5,6", "12:30",
                           "--", "0x10"})
    EXPECT_EQ(read_field(text).kind, Kind::Text) << text;
}

TEST(ReadField, GroupsOfThousandsBesideASeparatorOfDecimals) {
  EXPECT_EQ(read_field("1.234,5").value, 1234.5);
  EXPECT_EQ(read_field("-12,345,678.25").value, -12345678.25);
  EXPECT_EQ(read_field("1.234.567,0").value, 1234567.0);
}

TEST(ReadField, TheSignOfInfinity) {
  EXPECT_EQ(read_field("\u221e").value, std::numeric_limits<double>::infinity());
  EXPECT_EQ(read_field("-\u221e").value, -std::numeric_limits<double>::infinity());
}

TEST(ReadField, TheMinusSignOfTypesetting) {
  EXPECT_EQ(read_field("\u22121.5e\u22123").value, -1.5e-3);
  EXPECT_EQ(read_field("\"\u22120,25\"").value, -0.25);
  EXPECT_EQ(read_field("\u221212.345,5").value, -12345.5);
  EXPECT_EQ(read_field("\u2212\u221e").value, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(read_field("\u2212").kind, Kind::Missing) << "a dash";
  EXPECT_EQ(read_field("1\u22122").kind, Kind::Text);
}

TEST(SplitFields, UnitsInBracketsBelongToTheName) {
  EXPECT_THAT(fields_of("t [s]  F [N m] x", ' '), ElementsAre("t [s]", "F [N m]", "x"));
}

}  // namespace
}  // namespace lacuna
