// SPDX-License-Identifier: MIT
#include "data/formats/file_kinds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

TEST(FileKinds, SayWhatAFileLooksLike) {
  EXPECT_EQ(known_file("TDSm1234")->what, "a LabVIEW TDMS file");
  EXPECT_NE(known_file("PAR1")->remedy.find("read_parquet"), std::string::npos);
  EXPECT_NE(known_file("\x89MCAP0\r\n")->remedy.find("ros2 topic echo --csv"), std::string::npos);
  EXPECT_EQ(known_file("#ROSBAG V2.0\n")->what, "a ROS 1 bag");
  EXPECT_EQ(known_file("PK\x03\x04....")->what, "a zip archive");
  EXPECT_EQ(known_file("%PDF-1.7")->remedy, "give the file with the numbers");
  EXPECT_FALSE(known_file("t,x\n0,1\n"));
  EXPECT_FALSE(known_file(""));
}

TEST(FileKinds, WorkbooksAreRead) {
  EXPECT_EQ(kind_of("a.xlsx", "PK\x03\x04....xl/workbook.xml", "a.xlsx"), FileKind::Workbook);
  EXPECT_EQ(kind_of("a.csv", "t,x\n", "a.csv"), FileKind::Text);
}

TEST(FilesNamed, AreAllThatAWordMayMean) {
  const testing::TemporaryFolder folder;
  const std::string a = folder.write("a.csv", "1"), b = folder.write("b.csv", "2"),
                    plus = folder.write("c+d.csv", "3"), sign = folder.write("e#f.csv", "4");
  const auto named = [](const std::string& word) {
    std::vector<std::string> names;
    for (const auto& file : files_named(word)) names.push_back(file.string());
    return names;
  };
  using ::testing::Contains;
  using ::testing::ElementsAre;
  EXPECT_THAT(named(a), ElementsAre(a));
  EXPECT_THAT(named(a + "#Sheet 1"), Contains(a));
  EXPECT_THAT(named(a + "+" + b), ::testing::AllOf(Contains(a), Contains(b)));
  EXPECT_THAT(named(a + "+" + plus), ::testing::AllOf(Contains(a), Contains(plus)));
  EXPECT_THAT(named(sign), Contains(sign));
  EXPECT_THAT(named(folder.file("[ab].csv")), ElementsAre(a, b));
  EXPECT_THAT(named("-"), ElementsAre("/dev/stdin"));
  EXPECT_THAT(named("x*abs(x)"), ElementsAre());
  EXPECT_THAT(named(folder.file("none.csv")), ElementsAre());
}

}  // namespace
}  // namespace lacuna
