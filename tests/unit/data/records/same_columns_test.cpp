// SPDX-License-Identifier: MIT
#include "data/records/same_columns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/formats/read_text.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

Table table_with(const std::string& header, const std::string& source) {
  return parse_text_table(header + "\n0,1,2\n1,2,3\n", source);
}

TEST(NameInOrder, ColumnsWithoutNamesGetThoseOfTheRoles) {
  Table with_time = parse_text_table("0,1,2\n1,2,3\n", "a");
  name_in_order(with_time, {.states = {"x"}, .inputs = {"u"}});
  EXPECT_EQ(with_time.columns[0].name, "t");
  EXPECT_EQ(with_time.columns[1].name, "x");
  EXPECT_EQ(with_time.columns[2].name, "u");
  ASSERT_EQ(with_time.notes.size(), 1u);
  EXPECT_THAT(with_time.notes[0], ::testing::HasSubstr("are called t, x, u, in this order"));
  Table with_step = parse_text_table("0,1,2\n1,2,3\n", "a");
  name_in_order(with_step, {.step = 0.1, .states = {"x", "y", "z"}});
  EXPECT_EQ(with_step.columns[0].name, "x");
  EXPECT_EQ(with_step.columns[2].name, "z");
}

TEST(NameInOrder, OthersKeepTheirs) {
  for (const ColumnRoles& roles :
       {ColumnRoles{.states = {"x"}}, ColumnRoles{.states = {"c2", "y"}},
        ColumnRoles{.step = 0.1, .states = {"x", "y"}},
        ColumnRoles{.states = {"x", "sin"}}, ColumnRoles{.states = {"x", "x"}}}) {
    Table table = parse_text_table("0,1,2\n1,2,3\n", "a");
    name_in_order(table, roles);
    EXPECT_EQ(table.columns[1].name, "c2");
  }
  Table named = table_with("t,x,y", "a");
  name_in_order(named, {.states = {"a", "b"}});
  EXPECT_EQ(named.columns[1].name, "x");
}

}  // namespace
}  // namespace lacuna
