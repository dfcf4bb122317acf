// SPDX-License-Identifier: MIT
#include "data/formats/text_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/formats/read_text.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;

/// Rows of texts that follow each other.
Table rows_of(const std::vector<std::string>& blocks) {
  std::string text;
  for (const std::string& block : blocks) text += block;
  TextRows rows(*find_format(text, true, "a.csv"), "a.csv");
  Table all = rows.columns();
  all.values.resize(0, static_cast<Index>(all.columns.size()));
  for (const std::string& block : blocks) {
    Table table = rows.columns();
    rows.read(block, table);
    const Index before = all.values.rows();
    all.values.conservativeResize(before + table.values.rows(), Eigen::NoChange);
    all.values.bottomRows(table.values.rows()) = table.values;
    all.lines.insert(all.lines.end(), table.lines.begin(), table.lines.end());
  }
  rows.finish();
  return all;
}

void expect_same(const Table& table, const Table& expected) {
  EXPECT_EQ(table.values, expected.values);
  EXPECT_EQ(table.lines, expected.lines);
  EXPECT_EQ(table.notes, expected.notes);
  EXPECT_EQ(table.headers, expected.headers);
  EXPECT_EQ(table.run_column, expected.run_column);
}

TEST(TextRows, DialectsGoOnFromBlockToBlock) {
  const std::vector<std::vector<std::string>> texts = {
      {"time,x\n23:59:59.9,1\n", "00:00:00.1,2\n", "00:00:00.3,3\n"},
      {"X,CH1,Start,Increment,\nSequence,Volt,0,0.5,\n0,1,,\n", "1,2,,\n2,3,,\n"},
      {"time\tV(a)\nStep Information: R=1 (Step: 1/2)\n0\t1\n", "1e-3\t2\n2e-3\t2.5\n",
       "Step Information: R=2 (Step: 2/2)\n0\t3\n1e-3\t4\n"},
      {" 0.5 1.0 0.5 5.0\n", " 0.6 2.0 0.6 6.0\n 0.7 3.0 0.7 7.0\n"},
      {"Title: * rc\nNo. Variables: 2\nVariables:\n\t0\ttime\ttime\n\t1\tv(out)\tvoltage\n"
       "Values:\n 0\t0.0\n",
       "\t1.5\n\n 1\t0.1\n", "\t2.5\n"}};
  for (const auto& blocks : texts) {
    std::string text;
    for (const std::string& block : blocks) text += block;
    expect_same(rows_of(blocks), parse_text_table(text, "a.csv"));
  }
}

TEST(TextRows, LinesOfAFileCountWhereADialectHasPutNamesInFront) {
  const std::string text = " 0.5 1.0 0.5 5.0\n 0.6 2.0 0.6 6.0\n";
  EXPECT_THAT(parse_text_table(text, "a").lines, ElementsAre(1, 2));
  testing::expect_error<DataError>(
      [] {
        TextRows rows(*find_format("0 1 0 2\n1 1 1 2\n", true, "a"), "a");
        Table table = rows.columns();
        rows.read("0 1 0 2\n1 1 1 2\n", table);
        rows.read("2 1 2 x\n", table);
        rows.finish();
      },
      "a:3:3", "'x' in column 'c4'", "number");
}

}  // namespace
}  // namespace lacuna
