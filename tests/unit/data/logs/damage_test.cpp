// SPDX-License-Identifier: MIT
#include "data/logs/damage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/formats/read_text.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

/// So many lines of numbers below a header.
std::string lines_of_numbers(int count) {
  std::string text = "t,x\n";
  for (int i = 0; i < count; ++i)
    text += std::to_string(i) + "," + std::to_string(i % 7) + "\n";
  return text;
}

Table read(const std::string& text) { return parse_text_table(text, "a.csv"); }

TEST(Damage, ALineThatCannotBeReadIsAnErrorWhereBytesAreWhole) {
  testing::expect_error<DataError>([] { read(lines_of_numbers(900) + "900,ERR\n901,3\n"); },
                                   "a.csv:902:2", "'ERR'", "");
  testing::expect_error<DataError>([] { read(lines_of_numbers(900) + "900\n901,3\n"); },
                                   "a.csv:902:2", "1 field", "");
}

TEST(Damage, WhereBytesAreDamagedPartsOfLinesAreLostToo) {
  const Table table = read(lines_of_numbers(150) + "150,\xff" "2\n151,ERR\n152,3\n");
  EXPECT_EQ(table.values.rows(), 151);
  ASSERT_EQ(table.notes.size(), 2u);
  EXPECT_THAT(table.notes[1], HasSubstr("a.csv:153: 1 line that cannot be read, left out, here "
                                        "'151,ERR'"));
}

TEST(Damage, StrayBytesMayBeInMoreLines) {
  const Table table = read("t,x\n0,1\n1,\xff" "2\n" + lines_of_numbers(30).substr(4));
  EXPECT_EQ(table.values.rows(), 31);
  ASSERT_EQ(table.notes.size(), 1u);
  EXPECT_THAT(table.notes[0], HasSubstr("a.csv:3: 1 line with bytes that no text has"));
  testing::expect_error<DataError>([] { read("t,x\n0,1\n1,\xff" "2\n2,3\n"); }, "a.csv:3:2", "",
                                   "");
}

TEST(Damage, ALastLineWithoutAnEndMayBeCut) {
  const Table table = read(lines_of_numbers(20) + "20");
  EXPECT_EQ(table.values.rows(), 20);
  ASSERT_EQ(table.notes.size(), 1u);
  EXPECT_THAT(table.notes[0], HasSubstr("1 line cut off at the end"));
  testing::expect_error<DataError>([] { read(lines_of_numbers(20) + "20\n"); }, "a.csv:22:2",
                                   "1 field", "");
}

TEST(Damage, ASummaryEndsTheRecord) {
  const Table table = read(
      "Zeit;x\n0,0;1,5\n0,1;2,5\n0,2;3,5\n;\nMittelwert;2,5\nMax.;3,5\n\nStabw;eins\n");
  EXPECT_EQ(table.values.topRows(3).col(1), Eigen::Vector3d(1.5, 2.5, 3.5));
  ASSERT_EQ(table.notes.size(), 1u);
  EXPECT_THAT(table.notes[0], HasSubstr("a.csv:6: the record ends in front of 'Mittelwert;2,5', "
                                        "3 lines of a summary left out"));
  testing::expect_error<DataError>([] { read("t;x\n0;1\nSumme;2\n1;1\n"); }, "a.csv:3:1",
                                   "'Summe'", "");
  testing::expect_error<DataError>([] { read("t;x\n0;1\n1;1\nfoo;2\n"); }, "a.csv:4:1", "'foo'",
                                   "");
}

}  // namespace
}  // namespace lacuna
