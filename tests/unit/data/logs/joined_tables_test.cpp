// SPDX-License-Identifier: MIT
#include "data/logs/joined_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

/// The table of two files.
Table joined(const std::string& a, const std::string& b, const ColumnRoles& roles = {}) {
  const TemporaryFolder folder;
  return read_table(folder.write("a.csv", a) + "+" + folder.write("b.csv", b), roles);
}

std::vector<std::string> names_in(const Table& table) { return names_of(table.columns); }

TEST(JoinedOnTime, ThereIsARowForEachTime) {
  const Table table = joined("t [s],x [V]\n0,1\n1,2\n2,3\n", "u,t [s]\n10,0.5\n20,1\n30,1.5\n");
  EXPECT_THAT(names_in(table), ElementsAre("t", "x", "u"));
  EXPECT_TRUE(table.own_times);
  ASSERT_EQ(table.values.rows(), 5);
  for (Index i = 0; i < 5; ++i) EXPECT_EQ(table.values(i, 0), 0.5 * static_cast<double>(i));
  EXPECT_EQ(table.values(2, 1), 2.0);
  EXPECT_EQ(table.values(2, 2), 20.0);
  EXPECT_TRUE(std::isnan(table.values(1, 1)));
  EXPECT_TRUE(std::isnan(table.values(0, 2)));
  EXPECT_EQ(table.values(3, 2), 30.0);
}

TEST(JoinedOnTime, UnitsOfTimeAreBroughtToOne) {
  // 300 ms are 0.3 s but for the last digit of doubles.
  const Table table = joined("t [s],x\n0.1,1\n0.2,2\n0.3,3\n",
                             "time_ms,u\n100,1\n200,2\n300,3\n");
  EXPECT_EQ(table.values.rows(), 3);
  EXPECT_EQ(table.columns[0].unit, "s");
  EXPECT_FALSE(table.values.array().isNaN().any());
  const Table one = joined("t [ms],x\n100,1\n200,2\n", "t,u\n100,1\n200,2\n");
  EXPECT_EQ(one.values.rows(), 2);
  EXPECT_EQ(one.columns[0].unit, "ms");
  EXPECT_THAT(one.notes, Contains(HasSubstr("taken to be in ms")));
}

TEST(JoinedOnTime, ClocksAndCountedTimesHaveOneBegin) {
  const Table clocks =
      joined("time,x\n10:00:00.0,1\n10:00:00.5,2\n10:00:01.0,3\n10:00:01.5,4\n",
             "time,u\n10:00:00.5,1\n10:00:01.0,2\n10:00:01.5,3\n10:00:02.0,4\n");
  ASSERT_EQ(clocks.values.rows(), 5);
  EXPECT_EQ(clocks.values(1, 2), 1.0);
  EXPECT_EQ(clocks.values(4, 0), 2.0);
  const Table counted = joined("t [ns],x\n1700000000000000000,1\n1700000000001000000,2\n",
                               "t [ns],u\n1700000000001000000,5\n1700000000002000000,6\n");
  ASSERT_EQ(counted.values.rows(), 3);
  EXPECT_NEAR(counted.values(1, 0), 1e6, 1e3);
  EXPECT_EQ(counted.values(1, 2), 5.0);
}

TEST(JoinedOnTime, ColumnsWithoutNamesAreCounted) {
  EXPECT_THAT(names_in(joined("0,1\n1,2\n", "0,5\n1,6\n")), ElementsAre("c1", "c2", "c4"));
}

TEST(JoinedOnTime, SaysWhatDoesNotFit) {
  const auto refused = [](const std::string& a, const std::string& b, const std::string& problem,
                          const std::string& remedy, const ColumnRoles& roles = {}) {
    try {
      joined(a, b, roles);
      ADD_FAILURE() << "nothing was refused: " << problem;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(problem));
      EXPECT_THAT(error.what(), HasSubstr(remedy));
    }
  };
  const std::string plain = "t [s],x\n0,1\n1,2\n";
  refused(plain, "t [s],x\n0,1\n1,2\n", "'x' stands in", "rename it in one of them");
  refused(plain, "t [s],u\n10,1\n11,2\n", "have none in common", "one origin");
  refused(plain, "t [s],u\n1,1\n0,2\n", "b.csv:3:1: time goes backwards", "sort the lines");
  refused(plain, "t [V],u\n0,1\n1,2\n", "its time is in V", "units of time");
  refused(plain, "t,u\n10:00:00,1\n10:00:01,2\n", "those of a clock", "one origin");
  refused(plain, "t,u,run\n0,1,1\n1,2,1\n", "are not numbered", "one by one",
          {.trajectory = "run"});
  refused(plain, "u\n1\n2\n", "joined on their times", "leave it out", {.step = 0.1});
}

}  // namespace
}  // namespace lacuna
